// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fetches a case's scan and shows it; says what comes, and what does not.
import { fetchCases, mayPrepareCases, titleAmong } from "../case_data";
import { button, make, setText } from "../dom";
import type { CaseList } from "../protocol";
import { PathologyDialog } from "../pathology";
import { mayAddCases } from "./new_case_client";
import "./scan.css";
import { ScanDesk } from "./scan_desk";
import { fetchScannedCase, fetchVolume } from "./volume_client";

export function openScan(app: HTMLElement, wanted: string | undefined): () => void {
  const abort = new AbortController();
  let desk: ScanDesk | undefined;
  const note = make("p.secondary", { role: "status" }, "Loading…");
  app.replaceChildren(
    make(
      "main.page.scan-wait",
      {},
      make("h1", {}, "Scan"),
      note,
      make("div.page-ways", {}, make("a.button-link", { href: "#/" }, "Operate")),
    ),
  );
  const load = async (): Promise<void> => {
    const [cases, mayAdd, mayPrepare] = await Promise.all([
      fetchCases(),
      mayAddCases(),
      mayPrepareCases().catch(() => false),
    ]);
    const id = wanted ?? cases.open;
    const scanned = await fetchScannedCase(id, abort.signal);
    const percent = (part: number): void => {
      setText(note, `Loading the scan of ${scanned.pseudonym}: ${Math.round(100 * part)} %`);
    };
    const ct = await fetchVolume(id, "ct.nii.gz", abort.signal, percent);
    const labels = await fetchVolume(id, "labels.nii.gz", abort.signal).catch((error: unknown) => {
      if (abort.signal.aborted) throw error;
      return undefined; // bones without labels are seen too
    });
    if (abort.signal.aborted) return;
    const links = make("span.scan-links", {}, ...ways(cases, id, scanned.versionOf));
    const added = (): void => {
      fetchCases().then(
        (now) => {
          links.replaceChildren(...ways(now, id, scanned.versionOf));
        },
        () => undefined, // they are in the list when the page is opened next
      );
    };
    const here = cases.cases.find((one) => one.id === id);
    const prepare =
      mayPrepare && here !== undefined
        ? [
            button("Pathology…", "", () => {
              new PathologyDialog().open(id, titleAmong(here, cases.cases));
            }),
          ]
        : [];
    desk = new ScanDesk({ id, scanned, ct, labels, ways: [links, ...prepare], mayAdd, added });
    app.replaceChildren(desk.element);
    desk.begin();
  };
  load().catch((error: unknown) => {
    if (abort.signal.aborted) return;
    note.setAttribute("role", "alert");
    setText(note, error instanceof Error ? error.message : String(error));
    note.after(
      button("Try again", "", () => {
        abort.abort();
        desk?.dispose();
        window.dispatchEvent(new HashChangeEvent("hashchange"));
      }),
    );
  });
  return () => {
    abort.abort();
    desk?.dispose();
  };
}

/**
 * Where else one can go: another case's scan, the version before, where a run made it worse, and the
 * operation.
 */
function ways(cases: CaseList, id: string, before: string | undefined): HTMLElement[] {
  const choice = make(
    "select",
    { "aria-label": "Case" },
    ...cases.cases.map((one) => {
      const option = make("option", { value: one.id }, titleAmong(one, cases.cases));
      option.selected = one.id === id;
      return option;
    }),
  );
  choice.addEventListener("change", () => {
    location.hash = `#/scan/${encodeURIComponent(choice.value)}`;
  });
  const operate = make("a.button-link", { href: "#/" }, "Operate");
  const back =
    before === undefined || !cases.cases.some((one) => one.id === before)
      ? []
      : [
          make(
            "a.button-link",
            { href: `#/scan/${encodeURIComponent(before)}` },
            "Back to the version before",
          ),
        ];
  return cases.cases.length > 1 ? [choice, ...back, operate] : [operate];
}
