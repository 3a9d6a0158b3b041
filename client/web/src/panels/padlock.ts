// A padlock, open or closed.
import { html, type TemplateResult } from "lit-html";

export function padlock(closed: boolean): TemplateResult {
  return html`<svg viewBox="0 0 16 16" width="14" height="14" aria-hidden="true"><rect x="3" y="7" width="10" height="7" rx="1.5" fill="currentColor" /><path
    d=${closed ? "M5 7V5a3 3 0 0 1 6 0v2" : "M5 7V4a3 3 0 0 1 5.6-1.5"} fill="none" stroke="currentColor" stroke-width="1.6" /></svg>`;
}
