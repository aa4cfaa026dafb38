// What is known of the thing under a click.
import {rayOfPoint, turn} from "./sphere.js";

/// Box in W of what a picture sees of an entity, {low, high, pixels}; null without range.
export function seenBox(picture, planes, id) {
  const ids = planes.entity.planes.id, range = planes.range?.planes.Y, {width, height} = planes.entity;
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  let pixels = 0;
  for (let i = 0; i < ids.length; ++i) {
    if (ids[i] !== id) continue;
    ++pixels;
    if (!range || !(range[i] > 0) || !picture.panoramic) continue;
    const d = turn(picture.R, rayOfPoint(i % width + 0.5, Math.floor(i / width) + 0.5, width, height));
    for (const a of [0, 1, 2]) {
      const v = picture.p[a] + range[i] * d[a];
      low[a] = Math.min(low[a], v);
      high[a] = Math.max(high[a], v);
    }
  }
  return {pixels, low, high, known: low[0] < Infinity};
}

/// The box of the world where the file of entities has one and the point that was clicked lies in it (people walk out of
/// theirs), else that of what is seen.
export function boxOf(picture, planes, id, [x, y], said) {
  const seen = seenBox(picture, planes, id), {width, height} = planes.entity, r = planes.range?.planes.Y[y * width + x];
  if (!said?.low || !(r > 0)) return seen;
  const d = turn(picture.R, rayOfPoint(x + 0.5, y + 0.5, width, height));
  const inside = [0, 1, 2].every(a => picture.p[a] + r * d[a] > said.low[a] - SLACK && picture.p[a] + r * d[a] < said.high[a] + SLACK);
  return inside ? {pixels: seen.pixels, low: said.low, high: said.high, known: true, exact: true} : seen;
}

const SLACK = 0.05;  // metres
const metres = v => `${v.toFixed(2)} m`;

/// Rows of the card: [name, text].
export function cardRows({id, entity, category, range, distance, pixel, box, person}) {
  const rows = [["Id", String(id)], ["Name", entity?.name ?? "(not in entities.json)"], ["Category", entity?.category_path ?? category?.path ?? "?"],
                ["Kind", entity?.kind ?? "?"], ...(pixel ? [["Range", range > 0 ? metres(range) : "nothing hit"], ["Pixel", `column ${pixel[0]}, row ${pixel[1]}`], ["Seen", `${box.pixels} pixels`]] : [["Distance", metres(distance)]])];
  if (box.known) {
    rows.push([box.exact ? "3D box" : "3D box seen", box.high.map((v, a) => metres(v - box.low[a])).join(" × ")]);
    rows.push(["Box centre", box.high.map((v, a) => ((v + box.low[a]) / 2).toFixed(2)).join(", ")]);
  }
  if (person) {
    rows.push(["Person", `#${person.track_id}${person.character ? `, ${person.character}` : ""}`], ["State", [...new Set([person.locomotion, person.behaviour])].filter(Boolean).join(", ")]);
    if (person.velocity_world) rows.push(["Speed", `${Math.hypot(...person.velocity_world).toFixed(2)} m/s`]);
    if (person.visible_fraction !== undefined) rows.push(["Visible", `${Math.round(100 * person.visible_fraction)} %`]);
  }
  return rows;
}

export function fillList(list, rows) {
  list.replaceChildren();
  for (const [name, text] of rows) {
    const dt = document.createElement("dt"), dd = document.createElement("dd");
    dt.textContent = name;
    dd.textContent = text;
    list.append(dt, dd);
  }
}
