// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case's scan to be looked at. Its code is fetched when it is.
import { make } from "../dom";

/** @param id  of a case; the open one where there is none */
export function mountScan(app: HTMLElement, id: string | undefined): () => void {
  let isLeft = false;
  let leave: () => void = () => undefined;
  app.replaceChildren(make("p.secondary", { role: "status" }, "Loading…"));
  import("./scan_page").then(
    ({ openScan }) => {
      if (!isLeft) leave = openScan(app, id);
    },
    () => {
      if (isLeft) return;
      app.replaceChildren(
        make("p", { role: "alert" }, "The host does not answer. Reload the page."),
      );
    },
  );
  return () => {
    isLeft = true;
    leave();
  };
}
