// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The canvas that WebGL draws on: how large, how fine, and on a machine that cannot keep up how much
// simpler.
import * as THREE from "three";
import { drawsInSoftware, lostPicture } from "../dom";
import { DrawingPace, SOFTWARE_LEVEL, type Drawing } from "./drawing_pace_model";

export interface SurfaceHandlers {
  /** CSS pixels, and device pixels per CSS pixel. What was drawn is gone. */
  onSize(width: number, height: number, ratio: number): void;
  /** What was drawn is gone. */
  onLost(): void;
  onShadowPixels(side: number): void;
}

export class DrawingSurface {
  readonly canvas: HTMLCanvasElement;
  readonly renderer: THREE.WebGLRenderer;
  private readonly lost: HTMLElement;
  /** CSS pixels. */
  width = 1;
  height = 1;
  private readonly pace: DrawingPace;
  private drawing: Drawing;
  /** More shows nothing more. */
  private readonly finestPixelRatio: number;
  private readonly observer: ResizeObserver;
  private handlers: SurfaceHandlers | undefined;

  constructor(private readonly host: HTMLElement) {
    const software = drawsInSoftware();
    this.pace = new DrawingPace(software ? SOFTWARE_LEVEL : 0);
    this.drawing = this.pace.drawing;
    // Without antialiasing a still picture is drawn larger than it is shown.
    this.finestPixelRatio = Math.max(software ? 2 : 1, window.devicePixelRatio);
    this.renderer = new THREE.WebGLRenderer({
      antialias: !software,
      powerPreference: "high-performance",
    });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 0.9;
    // A lost context comes back empty.
    this.lost = lostPicture(this.canvas, () => {
      this.handlers?.onLost();
    });
    this.observer = new ResizeObserver(() => {
      this.resize();
    });
  }

  /** Takes its place in the page and follows its size. */
  start(handlers: SurfaceHandlers): void {
    this.handlers = handlers;
    handlers.onShadowPixels(this.drawing.shadowPixels);
    this.host.append(this.canvas, this.lost);
    this.observer.observe(this.host);
    this.resize();
  }

  /**
   * Whether to draw now, and if so as finely as the machine can.
   * @param changed  what is seen has changed since the last time
   */
  wantsDrawing(changed: boolean): boolean {
    if (this.width < 2 || this.height < 2) return false;
    const now = performance.now();
    if (changed) this.pace.moves(now);
    else if (!this.pace.rests(now)) return false;
    this.drawAs(this.pace.drawing);
    this.renderer.setViewport(0, 0, this.width, this.height);
    return true;
  }

  dispose(): void {
    this.observer.disconnect();
    this.renderer.dispose();
    this.canvas.remove();
    this.lost.remove();
  }

  /** On a machine that cannot keep up: coarser shadows, none, fewer pixels. */
  private drawAs(drawing: Drawing): void {
    const before = this.drawing;
    this.drawing = drawing;
    if (drawing.shadowPixels !== before.shadowPixels)
      this.handlers?.onShadowPixels(drawing.shadowPixels);
    if (this.pixelRatio() === this.renderer.getPixelRatio()) return;
    this.renderer.setPixelRatio(this.pixelRatio());
    this.resize();
  }

  private pixelRatio(): number {
    return Math.min(this.finestPixelRatio, this.drawing.pixelRatio);
  }

  private resize(): void {
    // A headset has a size of its own; the page's is taken up again after it.
    if (this.renderer.xr.isPresenting) return;
    this.width = this.host.clientWidth;
    this.height = this.host.clientHeight;
    if (this.width < 2 || this.height < 2) return;
    this.renderer.setSize(this.width, this.height, false);
    this.handlers?.onSize(this.width, this.height, this.renderer.getPixelRatio());
  }
}
