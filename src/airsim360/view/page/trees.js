// Behaviour trees of people and missions of the drone, edited in the page. The server reads and writes the XML, so that a tree
// edited here and by hand has the same bytes.
const $ = id => document.getElementById(id);
const LOOK_MS = 400, MOST_UNDONE = 200, MOST_LETTERS = 12;
const NEW_MISSION = '<root BTCPP_format="4"><BehaviorTree ID="mission"><Sequence><Takeoff/><Wait seconds="1"/></Sequence></BehaviorTree></root>';

const elementsOf = doc => [...doc.querySelectorAll("*")];
const parse = xml => new DOMParser().parseFromString(xml, "application/xml");

export class TreeEditor {
  constructor(live) {
    Object.assign(this, {live, kind: "people", texts: {}, done: [], undone: [], chosen: -1, active: new Set()});
    const on = (id, what, does) => $(id).addEventListener(what, e => this.guard(does(e)));
    $("trees").addEventListener("toggle", () => { if ($("trees").open) this.guard(this.open()); });
    on("tree-kind", "change", () => this.load($("tree-kind").value));
    on("tree-person", "change", () => this.loadPerson());
    on("tree-name", "change", () => { this.chosen = -1; this.draw(); });
    on("tree-undo", "click", () => this.step(this.done, this.undone));
    on("tree-redo", "click", () => this.step(this.undone, this.done));
    on("tree-apply", "click", () => this.apply());
    on("tree-stop", "click", () => this.live.ask({do: "stop"}));
    on("tree-save", "click", () => this.save());
    on("tree-xml", "change", () => this.take($("tree-xml").value, this.chosen));
    on("node-ports", "submit", e => e.preventDefault());
    on("node-ports", "change", e => this.edit(node => e.target.value === "" ? node.removeAttribute(e.target.name) : node.setAttribute(e.target.name, e.target.value)));
    on("node-inside", "click", () => this.add((node, made) => node.append(made)));
    on("node-after", "click", () => this.add((node, made) => node.after(made)));
    on("node-up", "click", () => this.move(node => node.previousElementSibling?.before(node)));
    on("node-down", "click", () => this.move(node => node.nextElementSibling?.after(node)));
    on("node-remove", "click", () => this.remove());
    $("tree-graph").addEventListener("click", e => { const row = e.target.closest("[data-order]"); if (row) this.choose(Number(row.dataset.order)); });
    $("tree-graph").addEventListener("dblclick", e => { const row = e.target.closest("[data-order]"), node = this.elements[row?.dataset.order]; if (node?.tagName === "SubTree") this.enter(node.getAttribute("ID")); });
    $("tree-graph").addEventListener("keydown", e => this.key(e));
    setInterval(() => this.lookOnce(), LOOK_MS);
  }
  /// Mistakes are told beside the tree.
  guard(promise) {
    return Promise.resolve(promise).then(() => {}, error => { $("tree-state").textContent = error.message; $("tree-state").classList.add("wrong"); });
  }
  say(text) { $("tree-state").textContent = text; $("tree-state").classList.remove("wrong"); }

  async open() {
    if (this.palette) return;
    const [palette, {trees, people}] = [await this.live.ask({do: "palette"}), await this.live.ask({do: "trees"})];
    Object.assign(this, {palette, people});
    for (const {name} of people) $("tree-person").append(new Option(name, name));
    await this.load(trees.length ? "people" : "mission");
  }
  async load(kind) {
    this.kind = $("tree-kind").value = kind;
    Object.assign(this, {done: [], undone: [], chosen: -1, active: new Set()});
    $("person-choice").hidden = kind !== "people";
    $("tree-stop").hidden = kind === "people";
    $("tree-apply").textContent = kind === "people" ? "Apply" : "Fly";
    $("node-new").replaceChildren(...this.palette[kind].map(({name, help}) => { const o = new Option(name, name); o.title = help; return o; }));
    if (kind === "people") return this.loadPerson();
    const xml = this.texts.mission ?? (await this.live.ask({do: "check", kind, xml: NEW_MISSION})).xml;
    this.show(xml, null);
    this.say("A mission for the drone.");
  }
  async loadPerson() {
    const {trees, people} = await this.live.ask({do: "trees"});
    if (!trees.length) throw new Error("nobody is in this world: start with --people N");
    const tree = people.find(({name}) => name === $("tree-person").value).tree, {xml} = await this.live.ask({do: "source", tree});
    this.running = xml;
    this.show(xml, tree);
    this.say(`${$("tree-person").value} follows ${tree}.`);
  }

  // The text is what counts; the graph is made of it.

  show(xml, tree) {
    this.xml = this.texts[this.kind] = xml;
    this.doc = parse(xml);
    const names = [...this.doc.querySelectorAll("BehaviorTree")].map(e => e.getAttribute("ID")), wanted = tree ?? $("tree-name").value;
    $("tree-name").replaceChildren(...names.map(name => new Option(name, name)));
    $("tree-name").value = names.includes(wanted) ? wanted : names.at(-1);
    this.draw();
  }
  /// A new text, if the server finds nothing wrong with it.
  async take(xml, chosen) {
    const {xml: written} = await this.live.ask({do: "check", kind: this.kind, xml});
    if (written !== this.xml) {
      this.done.push(this.xml);
      if (this.done.length > MOST_UNDONE) this.done.shift();
      this.undone = [];
    }
    this.chosen = chosen;
    this.show(written, null);
    this.say(this.running === written ? "As it runs." : `Changed: ${$("tree-apply").textContent} makes it count.`);
  }
  step(from, to) {
    if (!from.length) return;
    to.push(this.xml);
    this.show(from.pop(), null);
    this.say("");
  }
  async apply() {
    const {xml} = await this.live.ask({do: this.kind === "people" ? "apply" : "fly", xml: this.xml});
    this.running = xml;
    this.show(xml, null);
    this.say(this.kind === "people" ? "They follow it now." : "The drone flies it now.");
  }
  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.xml], {type: "application/xml"}));
    link.download = this.kind === "people" ? "trees.xml" : "mission.xml";
    link.click();
    URL.revokeObjectURL(link.href);
  }

  // Edits: on a copy, which counts once the server has read it.

  async edit(change) {
    const doc = parse(this.xml), node = elementsOf(doc)[this.chosen];
    if (!node) throw new Error("choose a node first");
    const next = change(node, doc) ?? node;
    await this.take(new XMLSerializer().serializeToString(doc), elementsOf(doc).indexOf(next));
  }
  add(put) {
    const info = this.infoOf($("node-new").value);
    return this.edit((node, doc) => {
      const made = doc.createElement(info.name);
      // What must be there and has no value yet is for the author to say: the server names it.
      for (const port of info.ports) if (port.default === null) made.setAttribute(port.name, this.firstValue(port));
      if (info.class === "Control" || info.class === "Decorator") made.append(...this.fewest(info, doc));
      put(node, made);
      return made;
    });
  }
  fewest(info, doc) {
    return Array.from({length: /If|While/.test(info.name) ? 2 : 1}, () => doc.createElement("AlwaysSuccess"));
  }
  firstValue({name}) {
    const values = {point: "0;0", to: "0;0;2", around: "0;0;2", at: "0;0;2", what: "0;0;2", who: $("tree-person").value, state: "standing", message: "hello", kind: "bench", value: "1", output_key: "{key}", p: "0.5"};
    return values[name] ?? "1";
  }
  move(how) { return this.edit(node => { how(node); return node; }); }
  remove() {
    return this.edit(node => {
      const next = node.previousElementSibling ?? node.nextElementSibling ?? node.parentElement;
      node.remove();
      return next;
    });
  }
  infoOf(tag) { return this.palette[this.kind].find(({name}) => name === tag); }

  // The graph.

  root() { return [...this.doc.querySelectorAll("BehaviorTree")].find(e => e.getAttribute("ID") === $("tree-name").value)?.firstElementChild; }
  draw() {
    this.elements = elementsOf(this.doc);
    if (this.running !== this.xml) this.active = new Set();  // what runs is another tree
    const root = this.root();
    if (!root?.contains(this.elements[this.chosen] ?? null)) this.chosen = this.elements.indexOf(root);
    $("tree-graph").replaceChildren(...(root ? [this.branch(root, 1)] : []));
    $("tree-xml").value = this.xml;
    $("tree-undo").disabled = !this.done.length;
    $("tree-redo").disabled = !this.undone.length;
    this.inspect();
    this.glow();
  }
  branch(element, level) {
    const box = document.createElement("div"), node = document.createElement("div"), name = document.createElement("b"), ports = document.createElement("span");
    const order = this.elements.indexOf(element), children = [...element.children];
    box.className = "branch";
    node.className = `node ${(this.infoOf(element.tagName)?.class ?? "SubTree").toLowerCase()}`;
    node.dataset.order = order;
    node.setAttribute("role", "treeitem");
    node.setAttribute("aria-level", level);
    if (children.length) node.setAttribute("aria-expanded", "true");
    name.textContent = element.getAttribute("name") ?? element.tagName;
    ports.textContent = [...element.attributes].filter(a => a.name !== "name").map(a => `${a.name} ${a.value}`).join(", ");
    node.append(name, ports);
    box.append(node);
    if (!children.length) return box;
    const below = document.createElement("div");
    below.className = "below";
    below.setAttribute("role", "group");
    below.append(...children.map(child => this.branch(child, level + 1)));
    box.append(below);
    return box;
  }
  rows() { return [...$("tree-graph").querySelectorAll("[data-order]")]; }
  choose(order, focus = true) {
    this.chosen = order;
    this.inspect();
    this.glow();
    if (focus) this.rows().find(row => Number(row.dataset.order) === order)?.focus();
  }
  key(e) {
    const rows = this.rows(), at = rows.findIndex(row => Number(row.dataset.order) === this.chosen), node = this.elements[this.chosen];
    const to = {ArrowDown: rows[at + 1], ArrowUp: rows[at - 1], Home: rows[0], End: rows.at(-1),
                ArrowLeft: rows.find(row => this.elements[row.dataset.order] === node?.parentElement),
                ArrowRight: rows.find(row => this.elements[row.dataset.order] === node?.firstElementChild)};
    if (e.key === "Enter" && node?.tagName === "SubTree") { e.preventDefault(); return this.enter(node.getAttribute("ID")); }
    if (e.key === "Delete") { e.preventDefault(); return this.guard(this.remove()); }
    if (!(e.key in to)) return;
    e.preventDefault();
    e.stopPropagation();
    if (to[e.key]) this.choose(Number(to[e.key].dataset.order));
  }
  /// Shows the tree that a SubTree stands for.
  enter(name) {
    $("tree-name").value = name;
    this.chosen = -1;
    this.draw();
    this.choose(this.chosen);
  }
  inspect() {
    const node = this.elements[this.chosen], info = node && this.infoOf(node.tagName);
    $("node-title").textContent = node?.tagName ?? "No node";
    $("node-help").textContent = info?.help ?? "";
    const ports = [{name: "name", help: "what it is called", default: ""}, ...(info?.ports ?? [...(node?.attributes ?? [])].filter(a => a.name !== "name"))];
    $("node-ports").replaceChildren(...(node ? ports.map(port => this.field(node, port)) : []));
  }
  field(node, {name, help, default: otherwise}) {
    const label = document.createElement("label"), input = document.createElement("input");
    Object.assign(input, {name, value: node.getAttribute(name) ?? "", placeholder: otherwise ?? "", autocomplete: "off"});
    label.append(name, " ", input);
    if (help) { const small = document.createElement("small"); small.textContent = help; label.append(small); }
    return label;
  }

  // What runs.

  /// One question at a time: a slow server is not asked faster than it answers.
  async lookOnce() {
    if (this.looking || !$("trees").open || !this.palette) return;
    this.looking = true;
    await this.look().catch(() => {});
    this.looking = false;
  }
  async look() {
    const kind = this.kind, person = $("tree-person").value;
    const said = await this.live.ask(kind === "people" ? {do: "mind", person} : {do: "mission"});
    if (kind !== this.kind || person !== $("tree-person").value) return;  // another one was chosen meanwhile
    this.know(said, kind === "people" ? person : "");
    this.active = new Set(this.running === this.xml ? said.active : []);
    this.glow();
    if ($("tree-state").classList.contains("wrong") || this.running !== this.xml) return;
    this.say(this.kind === "people" ? `${said.person}: ${said.state} (${said.cause})${said.inbox.length ? `, hears ${said.inbox.map(({type}) => type).join(", ")}` : ""}`
                                    : `${said.result}, ${said.seconds.toFixed(1)} s${said.log.length ? ` · ${said.log.at(-1)}` : ""}`);
  }
  /// What it knows: the blackboard as it is; messages also after they were read, the newest first.
  know({board, inbox, log, state, cause}, person) {
    if (person !== this.knows) Object.assign(this, {knows: person, letters: [], before: null});
    $("tree-board").replaceChildren(...board.flatMap(({key, value}) => [["dt", key], ["dd", value]].map(([tag, text]) => Object.assign(document.createElement(tag), {textContent: text}))));
    $("tree-board-none").hidden = board.length > 0;
    $("tree-letters-title").textContent = person ? "Messages and states" : "Log";
    if (person) this.hear(inbox, state, cause);
    const lines = person ? this.letters.map(({text}) => text) : [...log].reverse();
    if (lines.join() !== this.lines) $("tree-letters").replaceChildren(...lines.map(text => Object.assign(document.createElement("li"), {textContent: text})));
    this.lines = lines.join();
  }
  hear(inbox, state, cause) {
    const note = (text, key) => { this.letters.unshift({text, key}); this.letters.length = Math.min(this.letters.length, MOST_LETTERS); };
    for (const {type, from, sent} of inbox) {
      const key = `${type} ${from} ${sent}`;
      if (!this.letters.some(letter => letter.key === key)) note(`${type} ${from ? `from ${from}` : "as a command"}, sent at ${sent.toFixed(1)} s`, key);
    }
    if (this.before && this.before !== state) note(`${this.before} → ${state} (${cause})`);
    this.before = state;
  }
  /// Names of the trees in which something runs: a SubTree is no node of its own.
  activeTrees() {
    return new Set([...this.active].map(order => this.elements[order]?.closest("BehaviorTree")?.getAttribute("ID")));
  }
  glow() {
    const trees = this.activeTrees(), orderOf = element => this.elements.indexOf(element);
    for (const row of this.rows()) {
      const order = Number(row.dataset.order), element = this.elements[order];
      const within = element.tagName === "SubTree" && trees.has(element.getAttribute("ID")) && (this.active.has(orderOf(element.parentElement)) || element === this.root());
      const runs = within || this.active.has(order);
      row.classList.toggle("active", runs);
      row.setAttribute("aria-selected", order === this.chosen);
      row.tabIndex = order === this.chosen ? 0 : -1;
      row.setAttribute("aria-label", `${element.getAttribute("name") ?? element.tagName}${row.lastChild.textContent ? `, ${row.lastChild.textContent}` : ""}${runs ? ", running" : ""}`);
    }
  }
}
