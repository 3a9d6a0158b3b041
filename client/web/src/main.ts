// The viewer's table of contents: socket -> state -> draw, and input -> tool -> request.
import "./style.css";
import { exposeDebugHandle } from "./debug";
import { Bar } from "./panels/bar";
import { element } from "./panels/dom";
import { FigurePanel } from "./panels/figure_panel";
import { GoalPanel } from "./panels/goal_panel";
import { Toast } from "./panels/toast";
import { TrackerPanel } from "./panels/tracker_panel";
import { Connection } from "./protocol/connection";
import type { TextSocket } from "./protocol/rpc";
import { Session } from "./session";
import { Model } from "./state/model";
import { listenToKeys } from "./tools/keys";
import { listenToPointer } from "./tools/pointer";
import { Requests } from "./tools/requests";
import { Views } from "./views/views";

const model = new Model();
let session: Session | null = null;

const connection = new Connection(() => new WebSocket(socketAddress()) as TextSocket, {
  opened(rpc) {
    session?.end();
    session = new Session(rpc, model, () => connection.giveUpOnSocket());
    return session.start();
  },
  changed: (state) => model.setConnection(state),
});

const area = element("main", { className: "views", testid: "views" });
const views = makeViews();
const requests = new Requests(model, () => session);
const bar = new Bar(model, views, requests, () => connection.connect());
const panels = [new FigurePanel(), new GoalPanel(model, requests), new TrackerPanel(model, requests)];
const toast = new Toast();
document.body.append(
  bar.root,
  area,
  element("aside", { className: "side" }, ...panels.map(({ root }) => root)),
  toast.root,
);

listenToPointer(views, model, requests);
listenToKeys(views, model, requests);
exposeDebugHandle(model, views);
connection.connect();
requestAnimationFrame(frame);

function makeViews(): Views {
  try {
    return new Views(area);
  } catch (error) {
    document.body.append(element("p", { className: "fatal", text: "This browser gives the page no WebGL 2, without which nothing can be drawn." }));
    throw error;
  }
}

function frame(): void {
  const nowMs = performance.now();
  views.draw(model);
  bar.update(model, nowMs);
  for (const panel of panels) panel.update(model);
  toast.update(model, nowMs);
  session?.streams.ackDrawn();
  requestAnimationFrame(frame);
}

/** Beside the page, whatever path it is served under. */
function socketAddress(): string {
  const address = new URL("ws", document.baseURI);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.search = address.hash = "";
  return address.href;
}
