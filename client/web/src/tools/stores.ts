// The browser's stores, or none where it refuses them.
import type { Store } from "../state/settings";

/** For all pages of this browser. */
export function browserStore(): Store | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}

/** For this tab, over reloads. */
export function tabStore(): Store | null {
  try {
    return sessionStorage;
  } catch {
    return null;
  }
}
