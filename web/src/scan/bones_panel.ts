// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The fourth picture: the bones' surfaces in the labels' colours, with the crosshair among them. Drawn when
// it is turned or something moved, and at no other time.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { lostPicture, make } from "../dom";
import type { Vec3 } from "../protocol";

const KEY_RAD = Math.PI / 24;
/** Length of the crosshair's arms [mm]. */
const ARM_MM = 60;
const REST_MS = 150;

export interface BoneColor {
  readonly name: string;
  /** 0xbbggrr */
  readonly color: number;
}

export class BonesPanel {
  readonly element: HTMLElement;
  private readonly renderer = new THREE.WebGLRenderer({ antialias: true });
  private readonly camera = new THREE.PerspectiveCamera(24, 1, 10, 1000);
  private readonly controls: OrbitControls;
  private readonly scene = new THREE.Scene();
  private readonly bones = new THREE.Group();
  private readonly lines: THREE.LineSegments;
  private readonly lamp = new THREE.DirectionalLight("#fff4e4", 2.4);
  private readonly sizes: ResizeObserver;
  private isAsked = false;
  private isGone = false;
  private rest = 0;

  /** @param pick  a place on a bone was clicked [Patient, mm] */
  constructor(pick: (mm: Vec3) => void) {
    const { domElement: canvas } = this.renderer;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute(
      "aria-label",
      "Bones; drag or arrow keys turn them, a click takes the crosshair to a place on a bone",
    );
    this.element = make(
      "section.scan-panel.bones",
      { "aria-label": "Bones" },
      canvas,
      make("h2.scan-panel-title", {}, "3-D"),
      lostPicture(canvas, () => {
        this.ask();
      }),
    );
    this.scene.background = new THREE.Color("#0e1214"); // a clear colour is lost with the context
    this.renderer.setPixelRatio(Math.min(1.5, devicePixelRatio));
    const material = new THREE.LineBasicMaterial({ color: "#5cc8ff", depthTest: false });
    material.transparent = true;
    material.opacity = 0.6;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), material);
    this.lines.renderOrder = 2;
    this.scene.add(this.bones, this.lines, this.lamp, this.lamp.target);
    this.scene.add(new THREE.HemisphereLight("#dfeaf0", "#3a322b", 1.1));
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => {
      this.ask();
    });
    this.sizes = new ResizeObserver(() => {
      const { clientWidth, clientHeight } = this.element;
      if (clientWidth < 2 || clientHeight < 2) return;
      this.renderer.setSize(clientWidth, clientHeight, false);
      this.camera.aspect = clientWidth / clientHeight;
      this.camera.updateProjectionMatrix();
      this.ask();
    });
    this.sizes.observe(this.element);
    this.listen(canvas, pick);
  }

  dispose(): void {
    this.isGone = true;
    window.clearTimeout(this.rest);
    this.sizes.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** @param up  and `from`: how one looks at first, unit vectors of Patient */
  async load(url: string, colors: readonly BoneColor[], up: Vec3, from: Vec3): Promise<void> {
    const loaded = await new GLTFLoader().loadAsync(url);
    if (this.isGone) return;
    this.take(loaded.scene, colors);
    const box = new THREE.Box3().setFromObject(this.bones);
    if (box.isEmpty()) return;
    const radius = box.getBoundingSphere(new THREE.Sphere()).radius;
    box.getCenter(this.controls.target);
    this.camera.up.set(...up);
    this.camera.position
      .copy(this.controls.target)
      .addScaledVector(new THREE.Vector3(...from), 4.6 * radius);
    this.controls.update();
    this.ask();
  }

  /** In place of those of the same colours, of which there may be fewer now. @param glb  undefined: none is left */
  async mend(bones: readonly BoneColor[], glb: ArrayBuffer | undefined): Promise<void> {
    const loaded = glb === undefined ? undefined : await new GLTFLoader().parseAsync(glb, "");
    if (this.isGone) return;
    // A bone may have another name now, as the part of one that was split; its label's colour stays.
    for (const { color } of bones) this.dropBone(color);
    if (loaded !== undefined) this.take(loaded.scene, bones);
    this.ask();
  }

  private take(scene: THREE.Object3D, colors: readonly BoneColor[]): void {
    scene.updateMatrixWorld(true);
    scene.traverse((node) => {
      if (!(node instanceof THREE.Mesh)) return;
      const mesh = node as THREE.Mesh;
      const name = mesh.name !== "" ? mesh.name : (mesh.parent?.name ?? "");
      const bone = colors.find((one) => one.name === name);
      if (bone === undefined) return;
      const geometry = mesh.geometry.clone().applyMatrix4(mesh.matrixWorld);
      if (geometry.getAttribute("normal") === undefined) geometry.computeVertexNormals();
      this.setBone(bone, geometry);
    });
  }

  private dropBone(color: number): void {
    for (const mesh of this.bones.children.filter((one) => one.userData["color"] === color)) {
      (mesh as THREE.Mesh).geometry.dispose();
      this.bones.remove(mesh);
    }
  }

  /** New or in place of the one of this colour. */
  setBone({ name, color }: BoneColor, geometry: THREE.BufferGeometry): void {
    this.dropBone(color);
    const rgb = ((color & 255) << 16) | (color & 0xff00) | (color >>> 16);
    const material = new THREE.MeshStandardMaterial({ color: rgb, roughness: 0.75 });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.name = name;
    mesh.userData["color"] = color;
    this.bones.add(mesh);
    this.ask();
  }

  setCross([x, y, z]: Vec3, isShown: boolean): void {
    const a = ARM_MM;
    const ends = [x - a, y, z, x + a, y, z, x, y - a, z, x, y + a, z, x, y, z - a, x, y, z + a];
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
    this.lines.geometry.computeBoundingSphere();
    this.lines.visible = isShown;
    // While the crosshair moves the slices come first: without a graphics card this picture is the slow one.
    window.clearTimeout(this.rest);
    this.rest = window.setTimeout(() => {
      this.ask();
    }, REST_MS);
  }

  /** Once, before the next picture on the screen. */
  private ask(): void {
    if (this.isAsked || this.isGone) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      if (this.isGone) return;
      this.lamp.position.copy(this.camera.position);
      this.lamp.target.position.copy(this.controls.target);
      this.renderer.render(this.scene, this.camera);
    });
  }

  private listen(canvas: HTMLCanvasElement, pick: (mm: Vec3) => void): void {
    let down: readonly [number, number] | undefined;
    canvas.addEventListener("pointerdown", (event) => {
      down = [event.clientX, event.clientY];
    });
    canvas.addEventListener("pointerup", (event) => {
      if (down === undefined || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4)
        return;
      const box = canvas.getBoundingClientRect();
      const ray = new THREE.Raycaster();
      ray.setFromCamera(
        new THREE.Vector2(
          (2 * (event.clientX - box.left)) / box.width - 1,
          1 - (2 * (event.clientY - box.top)) / box.height,
        ),
        this.camera,
      );
      const hit = ray.intersectObjects(this.bones.children)[0];
      if (hit !== undefined) pick([hit.point.x, hit.point.y, hit.point.z]);
    });
    canvas.addEventListener("keydown", (event) => {
      const turns: Readonly<Record<string, readonly [number, number]>> = {
        ArrowLeft: [-KEY_RAD, 0],
        ArrowRight: [KEY_RAD, 0],
        ArrowUp: [0, -KEY_RAD],
        ArrowDown: [0, KEY_RAD],
      };
      const turn = turns[event.key];
      if (turn === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      const offset = this.camera.position.clone().sub(this.controls.target);
      const right = new THREE.Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(this.camera.up, turn[0]).applyAxisAngle(right, turn[1]);
      this.camera.position.copy(this.controls.target).add(offset);
      this.controls.update();
    });
  }
}
