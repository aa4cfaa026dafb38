// Flights of a run of language navigation: what was asked, what was decided where, and the way on the map.
const $ = id => document.getElementById(id);
const REF = "#9aa3b2", GOOD = "#7ee787", BAD = "#ff8f8f", GOAL = "#ffff00", DECISION = "#ffb000";

const spoken = value => typeof value === "number" ? String(Math.round(10 * value) / 10) : Array.isArray(value) ? `(${value.map(spoken).join(", ")})` : typeof value === "string" ? value : JSON.stringify(value);

/// What an answer says in a line: the reason after the rest; the text itself where it is no JSON object.
export function spokenAnswer(said) {
  let answer;
  try { answer = JSON.parse(said); } catch { return said; }
  if (answer === null || typeof answer !== "object") return said;
  const {reason, ...rest} = answer;
  const parts = Object.entries(rest).map(([name, value]) => value === true ? name : `${name.replace(/_(deg|m|world)$/, "")} ${spoken(value)}${name.endsWith("_deg") ? "°" : name.endsWith("_m") ? " m" : ""}`);
  return parts.join(", ") + (reason ? ` – ${reason}` : "");
}

export class Flights {
  constructor(app, flights) {
    Object.assign(this, {app, flights, current: null});
    for (const [i, {id, success}] of flights.entries()) $("flight").append(new Option(`${id} · ${success ? "success" : "failure"}`, i));
    $("flight").addEventListener("change", () => app.showFrame(flights[$("flight").value].first));
    $("flight-next").addEventListener("click", () => app.showFrame((flights[flights.indexOf(this.current) + 1] ?? flights[0]).first));
    app.map.marks = () => this.marks();
    $("flights").hidden = false;
  }
  /// The flight that a frame is of: they follow each other.
  of(frame) {
    let low = 0, high = this.flights.length - 1;
    while (low < high) { const middle = (low + high + 1) >> 1; this.flights[middle].first <= frame ? low = middle : high = middle - 1; }
    return this.flights[low];
  }
  /// A frame is looked at.
  show(frame) {
    const flight = this.of(frame);
    if (flight !== this.current) this.enter(flight);
    const passed = flight.decisions.filter(d => d.frame <= frame).length;
    for (const [i, row] of [...$("decisions").children].entries()) {
      row.firstChild.setAttribute("aria-current", i === passed - 1 ? "step" : "false");
      row.classList.toggle("to-come", i >= passed);
    }
    $("decisions").children[passed - 1]?.scrollIntoView({block: "nearest"});
    const last = flight.decisions[passed - 1];
    $("caption").textContent = last ? spokenAnswer(last.said) + (last.told ? ` (${last.told})` : "") : "";
    $("caption").hidden = !last;
  }
  enter(flight) {
    this.current = flight;
    $("flight").value = this.flights.indexOf(flight);
    $("instruction").textContent = flight.instruction;
    const {agent, view, success, end, distance, radius, path_length, geodesic_length, seconds, explanation} = flight;
    $("flight-end").textContent = `${success ? "Success" : "Failure"}: ${end}, ${distance.toFixed(1)} m from the goal (radius ${radius} m). ${agent}, ${view}: ` +
      `${path_length.toFixed(0)} m flown, ${geodesic_length.toFixed(0)} m are the shortest way, ${seconds.toFixed(0)} s.${explanation ? ` ${explanation}` : ""}`;
    $("decisions").replaceChildren(...flight.decisions.map(d => this.row(d)));
    $("decisions-none").hidden = flight.decisions.length > 0;
    this.app.map.setFlight([...flight.pred, ...flight.ref, flight.goal], flight.pred.length);
    this.app.listFlight(flight);
  }
  row(decision) {
    const row = document.createElement("li"), button = document.createElement("button"), {model} = decision;
    button.type = "button";
    button.textContent = `${decision.t.toFixed(1)} s: ${spokenAnswer(decision.said)}` +
      (decision.told ? ` · told: ${decision.told}` : "") + (model ? ` · ${model.model || "model"}, ${model.tokens_in} + ${model.tokens_out} tokens, ${Number(model.seconds).toFixed(1)} s` : "");
    button.addEventListener("click", () => this.app.showFrame(decision.frame));
    row.append(button);
    return row;
  }
  marks() {
    if (!this.current) return [];
    const {ref, pred, goal, radius, parts, success, decisions} = this.current;
    return [{points: ref, color: REF, dots: false}, {points: pred, color: success ? GOOD : BAD, dots: false}, {points: [goal], color: GOAL, radius},
            ...parts.map(p => ({points: [p], color: GOAL})), ...decisions.map(({p}) => ({points: [p], color: DECISION}))];
  }
  /// Where the goal is, for the picture.
  signs() { return this.current ? [{p: this.current.goal, text: "goal"}] : []; }
}
