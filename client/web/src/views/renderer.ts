// The WebGL renderer, as fine as the machine can bear: where a processor draws in place of a GPU, edges are not smoothed,
// round shapes and shadows are coarse, so that a drag still follows the hand. `?draw=fine` and `?draw=plain` in the address decide.
import { BasicShadowMap, PCFShadowMap, WebGLRenderer } from "three";

export function drawsPlainly(search: string): boolean {
  const asked = new URLSearchParams(search).get("draw");
  return asked === "plain" || (asked !== "fine" && drawnBySoftware());
}

export function makeRenderer(plain: boolean): WebGLRenderer {
  const renderer = new WebGLRenderer({ antialias: !plain });
  renderer.setScissorTest(true);
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = plain ? BasicShadowMap : PCFShadowMap;
  // One map serves the four panes of a drawing.
  renderer.shadowMap.autoUpdate = false;
  renderer.domElement.setAttribute("aria-hidden", "true");
  return renderer;
}

function drawnBySoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && named ? String(gl.getParameter(named.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|softpipe/i.test(name);
}
