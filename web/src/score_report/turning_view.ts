// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Something of the case to be turned by hand: drawn when it is turned, and at no other time.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { lostPicture, make } from "../dom";
import { faceNames, towards, type AnatomicalSide } from "../frames";
import type { CaseDescription } from "../protocol";
import type { StudioLight } from "../theatre";

const FIELD_OF_VIEW_DEG = 24;
const KEY_RAD = Math.PI / 24;

export interface TurnedWorld {
  readonly world: THREE.Scene;
  readonly light: StudioLight;
  /** Of what is looked at [m]. */
  readonly box: THREE.Box3;
  /** Places with names, in the renderer's metres. */
  readonly marks: readonly { readonly name: string; readonly at: THREE.Vector3 }[];
}

/** From where it is looked at at first. */
export interface TurnedFrom {
  readonly side: AnatomicalSide;
  readonly distanceM: number;
}

export interface TurningWords {
  /** For who does not see it. */
  readonly label: string;
  readonly caption: string;
}

export class TurningView {
  readonly element: HTMLElement;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.01, 1);
  private readonly controls: OrbitControls;
  private readonly labels: readonly HTMLElement[];
  private readonly sizes: ResizeObserver;
  private readonly centre: THREE.Vector3;

  static async make(
    description: CaseDescription,
    makeWorld: (renderer: THREE.WebGLRenderer) => Promise<TurnedWorld>,
    from: TurnedFrom,
    words: TurningWords,
  ): Promise<TurningView> {
    const turning = new THREE.WebGLRenderer({ antialias: true });
    try {
      const placed = await makeWorld(turning);
      return new TurningView(turning, placed, description, from, words);
    } catch (error) {
      turning.dispose();
      turning.forceContextLoss();
      throw error;
    }
  }

  private constructor(
    renderer: THREE.WebGLRenderer,
    private readonly placed: TurnedWorld,
    description: CaseDescription,
    { side, distanceM }: TurnedFrom,
    words: TurningWords,
  ) {
    this.renderer = renderer;
    renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    renderer.toneMapping = THREE.ACESFilmicToneMapping;
    placed.world.background = new THREE.Color("#11171a"); // a clear colour is lost with the context
    const canvas = renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${words.label}; drag, or arrow keys, turn it`);
    this.centre = placed.box.getCenter(new THREE.Vector3());
    const names = faceNames(description.side);
    const from = new THREE.Vector3(...towards(side, names));
    this.camera.up.set(...towards("Distal", names));
    this.camera.position.copy(this.centre).addScaledVector(from, distanceM);
    this.labels = placed.marks.map(({ name }) =>
      make("span.turning-label", { "aria-hidden": "true" }, name),
    );
    const lost = lostPicture(canvas, () => {
      placed.light.mirrorAnew();
      this.draw();
    });
    this.element = make(
      "figure.turning",
      {},
      make("div.turning-frame", {}, canvas, ...this.labels, lost),
      make("figcaption", {}, `Drag to turn, wheel nears. ${words.caption}`),
    );
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.copy(this.centre);
    this.controls.enablePan = false;
    this.controls.minDistance = 0.35 * distanceM;
    this.controls.maxDistance = 2.4 * distanceM;
    this.controls.addEventListener("change", () => {
      this.draw();
    });
    this.controls.update();
    canvas.addEventListener("keydown", (event) => {
      this.onKey(event);
    });
    this.sizes = new ResizeObserver(() => {
      const { clientWidth, clientHeight } = canvas.parentElement ?? canvas;
      if (clientWidth < 2 || clientHeight < 2) return;
      renderer.setSize(clientWidth, clientHeight, false);
      this.camera.aspect = clientWidth / clientHeight;
      this.camera.updateProjectionMatrix();
      this.draw();
    });
    this.sizes.observe(canvas.parentElement ?? canvas);
  }

  dispose(): void {
    this.sizes.disconnect();
    this.controls.dispose();
    this.placed.light.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private onKey(event: KeyboardEvent): void {
    const turns: Readonly<Record<string, readonly [number, number]>> = {
      ArrowLeft: [-KEY_RAD, 0],
      ArrowRight: [KEY_RAD, 0],
      ArrowUp: [0, -KEY_RAD],
      ArrowDown: [0, KEY_RAD],
    };
    const turn = turns[event.key];
    if (turn === undefined) return;
    event.preventDefault();
    const offset = this.camera.position.clone().sub(this.centre);
    const right = new THREE.Vector3().crossVectors(this.camera.up, offset).normalize();
    offset.applyAxisAngle(this.camera.up, turn[0]).applyAxisAngle(right, turn[1]);
    this.camera.position.copy(this.centre).add(offset);
    this.controls.update();
    this.draw();
  }

  private draw(): void {
    this.camera.updateMatrixWorld(true);
    this.placed.light.follow(this.camera, this.centre);
    this.renderer.render(this.placed.world, this.camera);
    const { clientWidth, clientHeight } = this.renderer.domElement;
    this.placed.marks.forEach(({ at }, index) => {
      const seen = at.clone().project(this.camera);
      const label = this.labels[index];
      if (label === undefined) return;
      const x = ((seen.x + 1) / 2) * clientWidth;
      const y = ((1 - seen.y) / 2) * clientHeight;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }
}
