// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What fingers do on a touch screen: slide, several at once, and hold.
/** Fingers, by the debugger: where each is [CSS px]. */
export class Fingers {
  constructor(page) {
    this.page = page;
  }

  async send(type, points) {
    this.session ??= await this.page.context().newCDPSession(this.page);
    await this.session.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(({ x, y }, id) => ({ x, y, id })),
    });
  }

  /** @param ways  of each finger, from and to */
  async slide(ways, steps = 8) {
    const at = (share) =>
      ways.map(({ from, to }) => ({
        x: from.x + share * (to.x - from.x),
        y: from.y + share * (to.y - from.y),
      }));
    await this.send("touchStart", at(0));
    for (let i = 1; i <= steps; ++i) {
      await this.send("touchMove", at(i / steps));
      await this.page.waitForTimeout(30);
    }
    await this.send("touchEnd", []);
  }

  async hold(locator, meanwhile) {
    const box = await locator.boundingBox();
    await this.send("touchStart", [
      { x: box.x + box.width / 2, y: box.y + box.height / 2 },
    ]);
    await meanwhile();
    await this.send("touchEnd", []);
  }
}
