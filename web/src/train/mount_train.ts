// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Loads the case and shows the room, or says why it cannot be shown.
import { fetchCase, fetchCases, fetchProcedures } from "../case_data";
import { button, make } from "../dom";
import { loadCaseScene } from "../theatre";
import { TrainPage } from "./train_page";

/** Shows the room in `app`; the returned function leaves it. */
export function mountTrain(app: HTMLElement): () => void {
  const waiting = make("main.waiting", {}, make("p", { role: "status" }, "Loading the case…"));
  app.replaceChildren(waiting);
  let page: TrainPage | undefined;
  let left = false;
  void (async () => {
    try {
      const [description, procedures, cases, scene] = await Promise.all([
        fetchCase(),
        fetchProcedures(),
        fetchCases(),
        loadCaseScene("/api/scene.glb"),
      ]);
      if (left) return;
      page = new TrainPage(app, description, procedures, scene);
      page.offerCases(cases);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      const again = button("Try again", "", () => {
        location.reload();
      });
      waiting.replaceChildren(
        make("h1", {}, "The case cannot be shown"),
        make("p", {}, why),
        again,
      );
    }
  })();
  return () => {
    left = true;
    page?.dispose();
  };
}
