// The viewer's table of contents: socket -> state -> draw, and input -> tool -> request.
import "./style.css";
import { exposeDebugHandle } from "./debug";
import { Bar } from "./panels/bar";
import { BodyPanel } from "./panels/body_panel";
import { Gallery, Help } from "./panels/dialogs";
import { GoalPanel } from "./panels/goal_panel";
import { Hints } from "./panels/hints";
import { JointPanel } from "./panels/joint_panel";
import { Tabs } from "./panels/tabs";
import { Toast } from "./panels/toast";
import { TogetherPanel } from "./panels/together_panel";
import { TrackerPanel } from "./panels/tracker_panel";
import { Connection } from "./protocol/connection";
import type { TextSocket } from "./protocol/rpc";
import { Session, type Identity } from "./session";
import { Model } from "./state/model";
import { loadSettings, saveSettings } from "./state/settings";
import { gizmoPlace } from "./tools/drag_gizmo";
import { listenToDrops } from "./tools/drop_sensor";
import { listenToKeys, type Hands } from "./tools/keys";
import { followLink, readLink, viewLink } from "./tools/link";
import { savePicture } from "./tools/picture";
import { listenToPointer } from "./tools/pointer";
import { Poses } from "./tools/poses";
import { Requests } from "./tools/requests";
import { browserStore, tabStore } from "./tools/stores";
import type { Theme } from "./views/palette";
import { Views } from "./views/views";

/** Drawn frames in a row that the panels let pass. */
const kPanelsWait = 2;

await painted();
const model = new Model();
model.settings = loadSettings(browserStore());
let session: Session | null = null;
let drawnPose = 0;
let panelsWaited = 0;
let settingsSeen = -1;
let chosenSeen = "";

const identity: Identity = {
  get user() {
    return model.settings.user;
  },
  resume: tabStore()?.getItem("posed.resume") ?? null,
  kept(resume) {
    identity.resume = resume;
    tabStore()?.setItem("posed.resume", resume);
  },
};

const connection = new Connection(() => new WebSocket(socketAddress()) as TextSocket, {
  async opened(rpc) {
    session?.end();
    session = new Session(rpc, model, () => connection.giveUpOnSocket(), identity);
    await session.start();
    requests.outbox.resend();
  },
  changed: (state) => model.setConnection(state),
});

const area = document.createElement("main");
area.className = "views";
area.dataset["testid"] = "views";
area.setAttribute("aria-label", "Views");
document.body.append(area);
const views = makeViews();
const requests = new Requests(model, () => session);
const poses = new Poses(model, requests, browserStore());
const help = new Help();
const gallery = new Gallery(model, views, requests);
const body = new BodyPanel(model, requests, poses, new JointPanel(model, requests));
const hands: Hands = {
  views, model, requests,
  page: { help: () => help.open(), gallery: () => gallery.open(), picture: () => savePicture(views.redraw(model, theme())), savePose: () => void body.keep() },
};
const bar = new Bar(model, hands, { reconnect: () => connection.connect(), link: () => void copyLink() });
const tabs = new Tabs([
  { id: "goals", title: "Goals", panel: new GoalPanel(model, requests) },
  { id: "body", title: "Body", panel: body },
  { id: "trackers", title: "Trackers", panel: new TrackerPanel(model, requests, () => views.cameras.here) },
  { id: "together", title: "Together", panel: new TogetherPanel(model, requests, rename) },
]);
const hints = new Hints(model, () => model.change({ hintsDone: true }));
const toast = new Toast(model);
document.getElementById("first")?.replaceWith(bar.root, hints.root);
document.body.append(tabs.root, toast.root, help.root, gallery.root);

listenToPointer(views, model, requests);
listenToKeys(hands);
listenToDrops(views, model, requests);
exposeDebugHandle(model, views);
const light = matchMedia("(prefers-color-scheme: light)");
light.addEventListener("change", () => model.touch("settings"));
const link = readLink(location.hash);
if (link) followLink(link, views, model);
connection.connect();
requestAnimationFrame(frame);

/** What the page's HTML says is on the screen before WebGL is asked for, which can take long. A hidden page paints nothing. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
    setTimeout(resolve, 300);
  });
}

function frame(): void {
  const start = performance.now();
  dress();
  followChoice();
  if (!model.people.quiet(start)) model.touch("people");
  const poseTime = model.poseTimeNs;
  const drew = views.draw(model, theme(), gizmoPlace(model));
  if (drew) model.frameMeter.count(start);
  // Panels wait for a frame that has nothing to draw, but not for long: no frame has to do both.
  if (!drew || ++panelsWaited > kPanelsWait) {
    panelsWaited = 0;
    for (const part of [bar, tabs, hints, toast]) part.update(start);
  }
  session?.streams.ackDrawn();
  const end = performance.now();
  if (poseTime !== drawnPose) bar.drew((drawnPose = poseTime), end);
  if (drew) model.work.push(end - start);
  if (model.work.length > 600) model.work.splice(0, 300);
  requestAnimationFrame(frame);
}

function dress(): void {
  if (settingsSeen === model.version.settings) return;
  settingsSeen = model.version.settings;
  document.documentElement.dataset["theme"] = theme();
  saveSettings(browserStore(), model.settings);
}

/** What is chosen in the views opens at the side. */
function followChoice(): void {
  const chosen = model.selectedSegment ? "body" : model.selectedGoal ? "goals" : "";
  const key = chosen + JSON.stringify(model.selectedSegment ?? model.selectedGoal);
  if (key === chosenSeen) return;
  chosenSeen = key;
  if (chosen) tabs.showNamed(chosen);
}

function theme(): Theme {
  const { theme } = model.settings;
  return theme === "auto" ? (light.matches ? "light" : "dark") : theme;
}

function rename(user: string): void {
  model.change({ user });
  connection.connect();
}

async function copyLink(): Promise<void> {
  const address = viewLink(location.href, views, model);
  history.replaceState(null, "", address);
  try {
    await navigator.clipboard.writeText(address);
    model.say("The link to this view is copied", "", true);
  } catch {
    model.say("The link to this view is in the address bar", "", true);
  }
}

function makeViews(): Views {
  try {
    return new Views(area);
  } catch (error) {
    const says = document.createElement("p");
    says.className = "fatal";
    says.textContent = "This browser gives the page no WebGL 2, without which nothing can be drawn.";
    document.body.append(says);
    throw error;
  }
}

/** Beside the page, whatever path it is served under. */
function socketAddress(): string {
  const address = new URL("ws", document.baseURI);
  address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
  address.search = address.hash = "";
  return address.href;
}
