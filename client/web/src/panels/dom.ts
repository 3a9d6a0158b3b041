// The little that the panels need of the DOM.
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  options: { className?: string; testid?: string; text?: string; title?: string } = {},
  ...children: Array<Node | string>
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  if (options.className) made.className = options.className;
  if (options.testid) made.dataset["testid"] = options.testid;
  if (options.text !== undefined) made.textContent = options.text;
  if (options.title) made.title = options.title;
  made.append(...children);
  return made;
}

export function button(label: string, testid: string, title: string, run: () => void): HTMLButtonElement {
  const made = element("button", { text: label, testid, title });
  made.type = "button";
  made.addEventListener("click", () => {
    run();
    // Else the next key would press the button again instead of reaching the views.
    made.blur();
  });
  return made;
}

/** Writing the same text again would make the browser lay the page out anew. */
export function setText(target: HTMLElement, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** Rows by key: kept while their key is there, made and removed as keys come and go, in the keys' order. */
export class Rows<R extends { root: HTMLElement; remove?(): void }> {
  readonly rows = new Map<string, R>();

  constructor(
    private readonly parent: HTMLElement,
    private readonly make: (key: string) => R,
  ) {}

  sync(keys: readonly string[]): void {
    const wanted = new Set(keys);
    for (const [key, row] of this.rows) {
      if (wanted.has(key)) continue;
      row.root.remove();
      this.rows.delete(key);
    }
    keys.forEach((key, i) => {
      const row = this.rows.get(key) ?? this.make(key);
      this.rows.set(key, row);
      if (this.parent.children[i] !== row.root) this.parent.insertBefore(row.root, this.parent.children[i] ?? null);
    });
  }
}

/** Fills a select without disturbing one that is open and unchanged. */
export function setOptions(select: HTMLSelectElement, options: ReadonlyArray<readonly [value: string, label: string]>, value: string): void {
  const key = JSON.stringify(options);
  if (select.dataset["options"] !== key) {
    select.dataset["options"] = key;
    select.replaceChildren(...options.map(([optionValue, label]) => new Option(label, optionValue)));
  }
  if (select.value !== value) select.value = value;
}
