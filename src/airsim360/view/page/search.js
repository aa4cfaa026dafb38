// "mailbox within 20 m", answered from the labels: which frames show a thing of that name or category, and how near.

// What people say -> what the categories are called.
const SPOKEN = {mailbox: ["post", "box"], mailboxes: ["post", "box"], letterbox: ["post", "box"], postbox: ["post", "box"], people: ["person"], pedestrian: ["person"], pedestrians: ["person"],
                streetlamp: ["street", "light"], lamppost: ["lamp", "post"], dustbin: ["trash", "can"], bin: ["waste"], automobile: ["car"]};

/// {words, within}: `within` is Infinity where the text says no distance.
export function parseQuestion(text) {
  const found = /^(.*?)(?:\s+(?:within|closer than|nearer than|<)\s*([\d.]+)\s*m(?:et(?:er|re)s?)?)?$/i.exec(text.trim());
  const words = found[1].replace(/^(frames?\s+)?(with\s+)?(an?\s+|the\s+)?/i, "").toLowerCase().split(/[\s_]+/).filter(Boolean).flatMap(word => SPOKEN[word] ?? [word]);
  return {words, within: found[2] === undefined ? Infinity : Number(found[2])};
}

const spoken = text => text.toLowerCase().replaceAll("_", " ");

/// Ids of the entities whose name or category path has all the words.
export function matching(entities, words) {
  return Object.entries(entities).filter(([, e]) => {
    const text = `${spoken(e.name)} ${spoken(e.category_path ?? e.category ?? "")}`;
    return words.every(word => text.includes(word));
  }).map(([id]) => Number(id));
}

/// Calls `onHit({frame, pixels, least})` for frames in order, `onProgress(done, all)` between; stops when `signal` is aborted.
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
    if (least === null || least <= within) onHit({frame: frames[i], pixels: pixels.get(frames[i]), least});
  }
  onProgress(frames.length, frames.length);
  return ids;
}
