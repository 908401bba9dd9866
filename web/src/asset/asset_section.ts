// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How instructors rated an arthroscopy, beside the program's score and no part of it; an
// instructor's own form opens below.
import { fetchAssetForms } from "../case_data";
import { button, make, setText } from "../dom";
import type { AssetForms } from "../protocol";
import { AssetEditor } from "./asset_editor";
import { formsTable } from "./forms_table";
import type { RatedAttempt } from "./kept_drafts";
import "./asset.css";

const ABOUT =
  "The program cannot judge this; a person can. It changes nothing in the score above. A form passes " +
  "where each of the eight domains is 3 or better, whatever the sum.";

export function assetSection(attempt: RatedAttempt, staying: { isLeft(): boolean }): HTMLElement {
  const saved = make("div.asset-saved", {}, make("p.secondary", {}, "Loading…"));
  const said = make("p.asset-said", { role: "status" });
  const place = make("div");
  const section = make(
    "section.asset",
    { "aria-labelledby": "asset-title" },
    make("h2", { id: "asset-title" }, "Rated by an instructor (ASSET)"),
    make("p.secondary", {}, ABOUT),
    saved,
    place,
    said,
  );
  const show = (forms: AssetForms): void => {
    section.classList.toggle("asset-empty", forms.forms.length === 0);
    saved.replaceChildren(
      forms.forms.length === 0
        ? make("p", {}, "No instructor has rated this attempt yet.")
        : formsTable(forms.forms),
    );
  };
  const edit = (forms: AssetForms): void => {
    const opener = button("", "", () => {
      editor.open();
      stand();
    });
    const editor = new AssetEditor(attempt, forms, said, show, () => {
      stand();
      opener.focus();
    });
    // Who rates does not look at what others said meanwhile.
    const stand = (): void => {
      saved.hidden = opener.hidden = editor.isOpen;
      setText(opener, editor.amends ? "Amend your form…" : "Rate this attempt…");
    };
    stand();
    place.replaceChildren(opener, editor.element);
  };
  fetchAssetForms(attempt.id).then(
    (forms) => {
      if (staying.isLeft()) return;
      show(forms);
      if (forms.may_rate) edit(forms);
    },
    (error: unknown) => {
      const why = error instanceof Error ? error.message : String(error);
      saved.replaceChildren(make("p.secondary", { role: "alert" }, why));
    },
  );
  return section;
}
