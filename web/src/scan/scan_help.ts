// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The help of the scan's page.
import { button, make } from "../dom";
import { keyCap } from "../key_caps";
import { SCAN_HELP } from "./scan_keys_model";

export function scanHelp(): HTMLDialogElement {
  const close = button("Close", "", () => {
    dialog.close();
  });
  const dialog = make(
    "dialog.scan-help",
    { "aria-labelledby": "scan-help-title" },
    make(
      "div",
      {},
      make("header", {}, make("h2", { id: "scan-help-title" }, "Mouse, keys, touch"), close),
      make(
        "div.scan-help-groups",
        {},
        ...SCAN_HELP.map((group) =>
          make(
            "section",
            {},
            make("h3", {}, group.title),
            make(
              "dl",
              {},
              ...group.lines.flatMap((line) => [
                make("dt", {}, keyCap(line.keys)),
                make("dd", {}, line.text),
              ]),
            ),
          ),
        ),
      ),
    ),
  );
  return dialog;
}
