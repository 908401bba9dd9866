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

  /** @param ways  of each finger, from and to, over what lies between where `over` is given */
  async slide(ways, steps = 8) {
    const between = (a, b, share) => ({
      x: a.x + share * (b.x - a.x),
      y: a.y + share * (b.y - a.y),
    });
    const at = (share) =>
      ways.map(({ from, to, over }) => {
        if (over === undefined) return between(from, to, share);
        return share < 0.5 ? between(from, over, 2 * share) : between(over, to, 2 * share - 1);
      });
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
