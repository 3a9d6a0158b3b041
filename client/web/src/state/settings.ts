// What a person likes, kept in this browser: theme, units, what is shown. Storage is handed in, so that tests own it.
export interface Settings {
  theme: "auto" | "dark" | "light";
  lengths: "mm" | "m";
  /** Segment frames on all segments. */
  frames: boolean;
  /** The range of the chosen joint. */
  limits: boolean;
  /** Metres of the grid that drags snap to; 0: none. */
  snap: number;
  /** What a drag on a cube's gizmo does. */
  gizmo: "move" | "turn";
  user: string;
  hintsDone: boolean;
}

export const defaultSettings: Settings = {
  theme: "auto",
  lengths: "mm",
  frames: false,
  limits: true,
  snap: 0,
  gizmo: "move",
  user: "",
  hintsDone: false,
};

export interface Store {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

const kKey = "posed.settings";

/** What is not there, or of another version, is as by default. A store that refuses (private windows) is no store. */
export function loadSettings(store: Store | null): Settings {
  try {
    const kept = JSON.parse(store?.getItem(kKey) ?? "{}") as Partial<Settings>;
    const known = Object.entries(defaultSettings).map(([key, value]) => {
      const mine = kept[key as keyof Settings];
      return [key, typeof mine === typeof value ? mine : value];
    });
    return Object.fromEntries(known) as unknown as Settings;
  } catch {
    return { ...defaultSettings };
  }
}

export function saveSettings(store: Store | null, settings: Settings): void {
  try {
    store?.setItem(kKey, JSON.stringify(settings));
  } catch {
    // A full store forgets; the page goes on.
  }
}
