// A list of any number of frames: only the rows in sight are in the page.
const ROW = 28, BEYOND = 6;

export class FrameList {
  constructor(box, onChoose) {
    Object.assign(this, {box, onChoose, rows: [], chosen: 0});
    this.space = document.createElement("div");
    this.space.className = "frame-space";
    this.space.setAttribute("role", "presentation");
    box.append(this.space);
    box.addEventListener("scroll", () => this.draw(), {passive: true});
    new ResizeObserver(() => this.draw()).observe(box);
    box.addEventListener("keydown", e => this.key(e));
    this.space.addEventListener("click", e => { const row = e.target.closest("[data-row]"); if (row) this.onChoose(this.rows[row.dataset.row]); });
  }
  /// Frames in the order of the list, and what is said of one.
  set(rows, describe) {
    Object.assign(this, {rows, describe});
    this.space.style.height = `${rows.length * ROW}px`;
    this.draw();
  }
  choose(frame) {
    this.chosen = frame;
    const row = this.rows.indexOf(frame);
    if (row >= 0) {
      const top = row * ROW, {scrollTop, clientHeight} = this.box;
      if (top < scrollTop || top + ROW > scrollTop + clientHeight) this.box.scrollTop = top - clientHeight / 2;
    }
    this.draw();
  }
  draw() {
    const first = Math.max(0, Math.floor(this.box.scrollTop / ROW) - BEYOND);
    const last = Math.min(this.rows.length, Math.ceil((this.box.scrollTop + this.box.clientHeight) / ROW) + BEYOND);
    this.space.replaceChildren();
    for (let row = first; row < last; ++row) this.space.append(this.option(row));
    const active = this.rows.indexOf(this.chosen);
    this.box.setAttribute("aria-activedescendant", active >= first && active < last ? `frame-row-${active}` : "");
  }
  option(row) {
    const option = document.createElement("div"), chosen = this.rows[row] === this.chosen;
    option.id = `frame-row-${row}`;
    option.dataset.row = row;
    option.className = "frame-row";
    option.style.top = `${row * ROW}px`;
    option.setAttribute("role", "option");
    option.setAttribute("aria-selected", chosen);
    option.setAttribute("aria-setsize", this.rows.length);
    option.setAttribute("aria-posinset", row + 1);
    option.textContent = this.describe(this.rows[row]);
    return option;
  }
  key(e) {
    const at = this.rows.indexOf(this.chosen), page = Math.max(1, Math.floor(this.box.clientHeight / ROW) - 1);
    const to = {ArrowDown: at + 1, ArrowUp: at - 1, PageDown: at + page, PageUp: at - page, Home: 0, End: this.rows.length - 1}[e.key];
    if (to === undefined || !this.rows.length) return;
    e.preventDefault();
    e.stopPropagation();
    this.onChoose(this.rows[Math.min(this.rows.length - 1, Math.max(0, to))]);
  }
}
