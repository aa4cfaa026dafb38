#!/usr/bin/env python3
"""How far the words alone get with questions: the most frequent answer of the same words, or else of the same type, learned on one half of
the pictures and asked of the other; also for each type of question. Prints accuracy, chance and their ratio; exit status 1 above 1.2
times chance. Of a type with few items that says little: the ratio is held against 1.2 and two standard deviations of guessing.

    python3 tools/text_only_baseline.py items.jsonl [more.jsonl …]
"""
import collections
import json
import re
import sys
import zlib

BAR, WAYS = 1.2, ("words", "type", "place")


def words(item):
    return " ".join(re.findall(r"[a-z0-9]+", item.get("question", item.get("expression", "")).lower()))


def shape(choices):
    """Choices without their order, as a text-only reader knows them."""
    return json.dumps(sorted(json.dumps(c) for c in choices))


class Tally:
    """Right answers of each way to guess, against what guessing blindly gets."""

    def __init__(self):
        self.items, self.chance, self.variance, self.right = 0, 0.0, 0.0, collections.Counter()

    def add(self, chance, right):
        self.items += 1
        self.chance += chance
        self.variance += chance * (1 - chance)
        self.right.update(right)

    def ratio(self, name):
        return self.right[name] / self.chance

    def bar(self):
        return BAR + 2 * self.variance ** 0.5 / self.chance


def guesses(item, exact, kind, place):
    """The names of the ways that guess an item right."""
    choices, answer = [json.dumps(c) for c in item["choices"]], json.dumps(item["answer"])
    right = [name for name, table in (("words", exact[words(item), shape(item["choices"])]), ("type", kind[item["type"]]))
             if max(choices, key=lambda c: table[c]) == answer]
    if max(range(len(choices)), key=lambda i: place[item["type"]][i]) == item["answer_index"]:
        right.append("place")
    return right


def main(paths):
    learn, ask = [], []
    for path in paths:
        for item in map(json.loads, open(path, encoding="utf-8")):
            picture = item["world"] + item["pictures"][0]["file"].rsplit("_", 1)[0]
            (learn if zlib.crc32(picture.encode()) % 2 else ask).append(item)
    if not ask or not learn:
        sys.exit("too few pictures to learn from")
    exact, kind, place = (collections.defaultdict(collections.Counter) for _ in range(3))
    for item in learn:
        answer = json.dumps(item["answer"])
        exact[words(item), shape(item["choices"])][answer] += 1
        kind[item["type"]][answer] += 1
        place[item["type"]][item["answer_index"]] += 1
    whole, by_type = Tally(), collections.defaultdict(Tally)
    for item in ask:
        right = guesses(item, exact, kind, place)
        for tally in (whole, by_type[item["type"]]):
            tally.add(1 / len(item["choices"]), right)
    print(f"{len(ask)} items asked, {len(learn)} learned from; the most frequent answer of the same words, of the same type, the most frequent place")
    print(f"{'':16} {'items':>6} {'chance':>7} " + " ".join(f"{name + ' x':>8}" for name in WAYS))
    worse = False
    for name, tally in [("all", whole), *sorted(by_type.items())]:
        ratios = [tally.ratio(way) for way in WAYS]
        over = max(ratios) > (BAR if tally is whole else tally.bar())
        worse |= over
        print(f"{name:16} {tally.items:6} {tally.chance / tally.items:7.3f} " + " ".join(f"{ratio:8.3f}" for ratio in ratios) + (" over the bar" if over else ""))
    return int(worse)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
