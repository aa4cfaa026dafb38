// "mailbox within 20 m", answered from the labels: which frames show a thing of that name or category, and how near.

// What people say -> what the categories are called.
const SPOKEN = {mailbox: ["post", "box"], mailboxes: ["post", "box"], letterbox: ["post", "box"], postbox: ["post", "box"], people: ["person"], pedestrian: ["person"], pedestrians: ["person"],
                streetlamp: ["street", "light"], lamppost: ["lamp", "post"], dustbin: ["trash", "can"], bin: ["waste"], automobile: ["car"]};

/// {words, within, said}: `within` is Infinity where the text says no distance; `said` are the words as they were typed.
export function parseQuestion(text) {
  const found = /^(.*?)(?:\s+(?:within|closer than|nearer than|<)\s*([\d.]+)\s*m(?:et(?:er|re)s?)?)?$/i.exec(text.trim());
  const said = found[1].replace(/^(frames?\s+)?(with\s+)?(an?\s+|the\s+)?/i, "").toLowerCase().split(/[\s_]+/).filter(Boolean);
  return {said: said.join(" "), words: said.flatMap(word => SPOKEN[word] ?? [word]), within: found[2] === undefined ? Infinity : Number(found[2])};
}

const spoken = text => text.toLowerCase().replaceAll("_", " ");

/// Ids of the entities whose name or category path has all the words.
export function matching(entities, words) {
  return Object.entries(entities).filter(([, e]) => {
    const text = `${spoken(e.name)} ${spoken(e.category_path ?? e.category ?? "")}`;
    return words.every(word => text.includes(word));
  }).map(([id]) => Number(id));
}

/// Names of things that have the most of the words, where none has all: what might have been meant.
export function nearMisses(entities, words, most = 6) {
  const found = new Map();
  for (const e of Object.values(entities)) {
    const text = `${spoken(e.name)} ${spoken(e.category_path ?? e.category ?? "")}`, name = e.name.replace(/\s+\d+$/, "");
    const count = words.filter(word => text.includes(word)).length;
    if (count) found.set(name, Math.max(count, found.get(name) ?? 0));
  }
  const best = Math.max(0, ...found.values());
  return [...found].filter(([, count]) => count === best).map(([name]) => name).sort().slice(0, most);
}

/// Calls `onHit({frame, pixels, least, ids})` for frames in order, `onProgress(done, all)` between; stops when `signal` is aborted.
export async function search(dataset, view, {words, within}, signal, onHit, onProgress) {
  const entities = await dataset.entities(), seen = await dataset.appearances();
  const ids = matching(entities, words), pixels = new Map();
  for (const id of ids) for (let i = 0, list = seen[id] ?? []; i < list.length; i += 2) pixels.set(list[i], (pixels.get(list[i]) ?? 0) + list[i + 1]);
  const frames = [...pixels.keys()].sort((a, b) => a - b);
  for (let i = 0; i < frames.length && !signal.aborted; ++i) {
    let least = null;
    if (within < Infinity) {
      ({least} = await dataset.nearest(frames[i], view, ids));
      if (signal.aborted) return ids;
      onProgress(i + 1, frames.length);
    }
    if (least === null || least <= within) onHit({frame: frames[i], pixels: pixels.get(frames[i]), least, ids});
  }
  onProgress(frames.length, frames.length);
  return ids;
}
