// The two sheets: help with every key, and the scenes. The browser's own dialogs: focus stays inside, Escape closes.
import { html, nothing, render, type TemplateResult } from "lit-html";
import type { Model } from "../state/model";
import { keys } from "../tools/keys";
import type { Requests } from "../tools/requests";
import type { Views } from "../views/views";

function sheet(testid: string, label: string): HTMLDialogElement {
  const dialog = document.createElement("dialog");
  dialog.dataset["testid"] = testid;
  dialog.setAttribute("aria-label", label);
  // A click beside the sheet closes it.
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  return dialog;
}

function head(title: string, dialog: HTMLDialogElement): TemplateResult {
  return html`<header class="sheet-head"><h1>${title}</h1><button type="button" class="quiet" aria-label="Close" @click=${() => dialog.close()}>×</button></header>`;
}

export class Help {
  readonly root = sheet("help-sheet", "Help");

  open(): void {
    const groups = ["Look", "Goals", "Body", "Everything"] as const;
    render(html`${head("Pose a figure by pulling at it", this.root)}
      <div class="help-intro">
        <img src="./help/studio.webp" alt="The four views: a figure sits where four goals pull it; each goal is a cube joined by a line to the point that it pulls" width="480" height="270" />
        <div>
          <p>A <b>goal</b> is a cube that pulls a point of the body. Drag it, and the body follows as far as its joints and its other goals let it; more weight pulls harder.</p>
          <p><i class="state" data-state="reached"></i> reached <i class="state" data-state="balanced"></i> held by other goals or pins <i class="state" data-state="limited"></i> held by a joint's limit <i class="state" data-state="unreachable"></i> out of reach</p>
          <p>Click a part of the body to set its joint, pin it or turn it by its rings. Drag an empty place to orbit or pan; the wheel zooms at the pointer; two fingers do both.</p>
        </div>
      </div>
      <div class="key-groups">${groups.map((group) => html`<section><h2>${group}</h2><dl>${keys.filter((key) => key.group === group).map(({ keys: name, says }) => html`
        <div><dt><kbd>${name.length === 1 ? name.toUpperCase() : name}</kbd></dt><dd>${says}</dd></div>`)}</dl></section>`)}</div>`, this.root);
    this.root.showModal();
  }
}

/** What the paper shows, in its words' order. */
const kScenes: ReadonlyArray<readonly [name: string, title: string, says: string]> = [
  ["standing", "Standing", "Feet pinned, arms down, in balance: begin here"],
  ["empty", "Empty", "A figure without goals or pins"],
  ["paper/single-reach", "A single reach", "Figures 3 and 4: one goal for the right hand"],
  ["paper/two-reaches", "Two reaches", "Figure 5: two goals that can both be met"],
  ["paper/unreachable", "Out of reach", "Figures 6 and 7: weights 40 and 10 share what is missing"],
  ["paper/sitting", "Sitting", "Figures 8 and 9: hips 100, back and knees 10"],
  ["paper/restrained", "Restrained", "Figure 10: held at the hips, the hand reaches"],
  ["paper/seat-belt", "Seat belt", "Figure 11: hips and shoulder strapped"],
  ["paper/two-hands", "Two hands", "Both hands at one place"],
  ["paper/straighten", "Straighten", "Pulled at both ends, the body straightens"],
];

export class Gallery {
  readonly root = sheet("gallery", "Scenes");

  constructor(
    private readonly model: Model,
    private readonly views: Views,
    private readonly requests: Requests,
  ) {}

  open(): void {
    this.redraw();
    this.root.showModal();
  }

  private redraw(): void {
    const { templates, saved, mayEdit } = this.model;
    const known = kScenes.filter(([name]) => templates.includes(name));
    const others = templates.filter((name) => !kScenes.some(([other]) => other === name)).map((name) => [name, name, ""] as const);
    const save = (event: Event) => {
      event.preventDefault();
      const name = new FormData(event.target as HTMLFormElement).get("name");
      if (typeof name === "string" && name) void this.requests.saveScene(name).then(() => this.redraw());
    };
    render(html`${head("Scenes", this.root)}
      <ul class="gallery">${[...known, ...others].map(([name, title, says]) => html`<li><button type="button" class="card" data-testid="scene-${name}" ?disabled=${!mayEdit} @click=${() => void this.begin(name, "new")}>
        ${says ? html`<img src="./gallery/${name.replace("/", "-")}.webp" alt="" loading="lazy" width="200" height="150" />` : nothing}
        <b>${title}</b><span>${says}</span></button></li>`)}</ul>
      <h2>Saved</h2>
      <form class="line" @submit=${save}><input name="name" data-testid="save-name" aria-label="Name to save this scene by" placeholder="name" maxlength="64" /><button data-testid="save-scene" ?disabled=${!mayEdit}>Save this scene</button></form>
      ${saved.length === 0 ? html`<p class="empty">None yet. A new scene replaces the present one for everybody; Ctrl+Z brings it back.</p>` : nothing}
      <ul class="saved">${saved.map((name) => html`<li><button type="button" data-testid="open-${name}" ?disabled=${!mayEdit} @click=${() => void this.begin(name, "open")}>${name}</button></li>`)}</ul>`, this.root);
  }

  private async begin(name: string, how: "new" | "open"): Promise<void> {
    this.root.close();
    const revision = await (how === "open" ? this.requests.openScene(name) : this.requests.newScene(name));
    if (revision !== undefined) this.views.fitFrom(revision);
  }
}
