// The bar at the top: the connection, the scene menu, the pose buttons and the meter.
import type { ConnectionState } from "../protocol/connection";
import type { Model } from "../state/model";
import { toggleMaking } from "../tools/keys";
import type { Requests } from "../tools/requests";
import type { Views } from "../views/views";
import { button, element, setOptions, setText } from "./dom";

export class Bar {
  readonly root = element("header", { className: "bar" });
  private readonly connection = element("button", { className: "connection", testid: "connection" });
  private readonly scenes = element("select", { testid: "scene-menu", title: "Begin a new scene" });
  private readonly goal: HTMLButtonElement;
  private readonly fps = element("span", { className: "number", testid: "meter-fps" });
  private readonly lost = element("span", { className: "number", testid: "meter-lost" });
  private readonly trip = element("span", { className: "number", testid: "meter-trip" });

  constructor(model: Model, views: Views, requests: Requests, reconnect: () => void) {
    this.connection.type = "button";
    this.connection.addEventListener("click", () => model.connection.phase === "lost" && reconnect());
    this.scenes.setAttribute("aria-label", "new scene");
    this.scenes.addEventListener("change", () => {
      void this.beginScene(views, requests);
      this.scenes.value = "";
      this.scenes.blur();
    });
    this.goal = button("+ Goal", "tool-goal", "Then click a part of the figure (G, or shift-click)", () => toggleMaking(model, !model.makingGoal));
    this.root.append(
      element("span", { className: "brand", text: "posed" }),
      this.connection,
      element("span", { className: "gap" }),
      this.scenes,
      button("Start pose", "pose-start", "Standing, arms down", () => requests.resetPose("start")),
      button("Rest pose", "pose-rest", "The figure's rest: a T-pose", () => requests.resetPose("rest")),
      this.goal,
      button("Frame", "frame-all", "Frame the figures in all views (F)", () => views.fit(model)),
      element("span", { className: "grow" }),
      element("span", { className: "meter", testid: "meter" }, this.fps, this.lost, this.trip),
    );
  }

  private async beginScene(views: Views, requests: Requests): Promise<void> {
    const [kind, name = ""] = this.scenes.value.split(/:(.*)/s);
    const revision = await (kind === "open" ? requests.openScene(name) : requests.newScene(name));
    if (revision !== undefined) views.fitFrom(revision);
  }

  update(model: Model, nowMs: number): void {
    const phase = model.connection.phase;
    this.connection.dataset["phase"] = document.body.dataset["phase"] = phase;
    setText(this.connection, connectionText(model.connection, nowMs));
    this.connection.title = phase === "lost" ? "Click to try now" : daemonText(model);
    setOptions(
      this.scenes,
      [
        ["", "New scene…"],
        ...model.templates.map((name) => [`new:${name}`, name] as const),
        ...model.saved.map((name) => [`open:${name}`, `saved: ${name}`] as const),
      ],
      "",
    );
    this.goal.classList.toggle("on", model.makingGoal);
    setText(this.fps, `${Math.round(model.poseMeter.perSecond(nowMs))} poses/s`);
    setText(this.lost, `${model.lost.pose ?? 0} dropped`);
    const lost = Object.entries(model.lost).map(([stream, count]) => `${stream} ${count}`);
    this.lost.title = `Frames the daemon left out because this page was slower: ${lost.join(", ") || "none"}`;
    setText(this.trip, model.roundTripMs === null ? "" : `${model.roundTripMs.toFixed(model.roundTripMs < 10 ? 1 : 0)} ms`);
  }
}

export function connectionText(state: ConnectionState, nowMs: number): string {
  if (state.phase === "connecting") return "connecting…";
  if (state.phase === "connected") return "connected";
  return `lost, reconnecting in ${Math.max(0, Math.ceil((state.retryAtMs - nowMs) / 1000))} s`;
}

function daemonText(model: Model): string {
  return model.hello ? `${model.hello.daemon.name} ${model.hello.daemon.version}` : "";
}
