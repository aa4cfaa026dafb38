#!/usr/bin/env python3
"""How far the words alone get with questions: the most frequent answer of the same words, or else of the same type, learned on one half of
the pictures and asked of the other. Prints accuracy, chance and their ratio; exit status 1 above 1.2 times chance.

    python3 tools/text_only_baseline.py items.jsonl
"""
import collections
import json
import re
import sys
import zlib


def words(item):
    return " ".join(re.findall(r"[a-z0-9]+", item.get("question", item.get("expression", "")).lower()))


def shape(choices):
    """Choices without their order, as a text-only reader knows them."""
    return json.dumps(sorted(json.dumps(c) for c in choices))


def main(path):
    items = [json.loads(line) for line in open(path, encoding="utf-8")]
    learn, ask = [], []
    for item in items:
        (learn if zlib.crc32(item["pictures"][0]["file"].rsplit("_", 1)[0].encode()) % 2 else ask).append(item)
    exact, kind, place = (collections.defaultdict(collections.Counter) for _ in range(3))
    for item in learn:
        answer = json.dumps(item["answer"])
        exact[words(item), shape(item["choices"])][answer] += 1
        kind[item["type"]][answer] += 1
        place[item["type"]][item["answer_index"]] += 1
    total = collections.Counter()
    for item in ask:
        choices = [json.dumps(c) for c in item["choices"]]
        right = json.dumps(item["answer"])
        for name, table in (("words", exact[words(item), shape(item["choices"])]), ("type", kind[item["type"]])):
            guess = max(choices, key=lambda c: table[c])
            total[name] += guess == right
        total["place"] += max(range(len(choices)), key=lambda i: place[item["type"]][i]) == item["answer_index"]
        total["chance"] += 1 / len(choices)
    if not ask or not learn:
        sys.exit("too few pictures to learn from")
    worst = 0
    print(f"{len(ask)} items asked, {len(learn)} learned from; chance {total['chance'] / len(ask):.4f}")
    for name in ("words", "type", "place"):
        ratio = total[name] / total["chance"]
        worst = max(worst, ratio)
        print(f"most frequent answer by {name:6} {total[name] / len(ask):.4f}, {ratio:.3f} x chance")
    return int(worst > 1.2)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
