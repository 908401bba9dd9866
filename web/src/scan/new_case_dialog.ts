// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a scan is dropped or chosen, and where one sees how far the host is with a new case.
import { button, make, setText } from "../dom";
import { fromDrop, fromFiles } from "./brought_files";
import { scanAmong, type Candidate } from "./brought_files_model";
import { makeNewCase, type NewCaseWish } from "./new_case_client";
import { progressText } from "./new_case_model";
import { askForSeries } from "./series_choice";

const LONGEST_TITLE = "80";

export class NewCaseDialog {
  readonly element: HTMLDialogElement;
  private readonly title = make("input", {
    type: "text",
    maxlength: LONGEST_TITLE,
    autocomplete: "off",
  });
  private readonly note = make("p.new-case-note", { role: "status" });
  private readonly bar = make("progress", { max: "1", "aria-label": "How far it is" });
  private readonly choice: HTMLElement;
  private readonly series = make("div");
  private readonly done = make("div.actions");
  private readonly cancel: HTMLButtonElement;
  private readonly heading = make("h2", { id: "new-case-title" });
  private running: AbortController | undefined;

  /** @param made  a case was made: what else is to know it */
  constructor(private readonly made: (id: string) => void = () => undefined) {
    const chosen = (multiple: Readonly<Record<string, string>>): HTMLInputElement => {
      const input = make("input", { type: "file", hidden: "", ...multiple });
      input.addEventListener("change", () => {
        void this.bring(fromFiles([...(input.files ?? [])]));
        input.value = "";
      });
      return input;
    };
    const files = chosen({ multiple: "", "aria-label": "Files or a zip" });
    const folder = chosen({ webkitdirectory: "", "aria-label": "A folder" });
    this.choice = make(
      "div.new-case-choice",
      {},
      make("label", {}, "What the case is called; never a person's name ", this.title),
      make(
        "div.new-case-drop",
        {},
        make("p", {}, "Drop a folder, a zip file or files here: one CT, DICOM or a volume."),
        make(
          "p.secondary",
          {},
          "Of an adult: growth plates and bones that are not ossified yet are not known here.",
        ),
        make(
          "div.scan-row",
          {},
          button("Choose files…", "", () => {
            files.click();
          }),
          button("Choose a folder…", "", () => {
            folder.click();
          }),
          files,
          folder,
        ),
      ),
      make(
        "p.secondary",
        {},
        "It goes to the station that serves this page and nowhere else. What is brought is deleted when " +
          "the case is made; names and dates of birth are not read.",
      ),
    );
    this.cancel = button("Cancel", "", () => {
      this.close();
    });
    this.element = make(
      "dialog.new-case",
      { "aria-labelledby": "new-case-title" },
      this.heading,
      this.choice,
      this.bar,
      this.note,
      this.series,
      this.done,
      make("div.actions", {}, this.cancel),
    );
    this.element.addEventListener("cancel", (event) => {
      event.preventDefault();
      this.close();
    });
    this.element.addEventListener("keydown", (event) => {
      event.stopPropagation();
    });
    for (const name of ["dragover", "drop"] as const) {
      this.element.addEventListener(name, (event) => {
        event.preventDefault();
        event.stopPropagation();
        if (name === "drop") this.drop(event);
      });
    }
  }

  /** For a scan. */
  open(): void {
    this.show("Add a scan", true);
  }

  /** @param event  a drop, here or anywhere on the page */
  drop(event: DragEvent): void {
    const { dataTransfer } = event;
    if (dataTransfer === null || this.running !== undefined) return;
    const brought = fromDrop(dataTransfer);
    if (!this.element.open) this.open();
    void this.bring(brought);
  }

  /** Makes a new version of a case at once. */
  async makeVersion(of: string, labels: Blob): Promise<void> {
    this.show("A new version of the case", false);
    const files = (async function* () {
      await Promise.resolve();
      yield { as: "nii.gz", content: labels };
    })();
    const choose = (): Promise<number> => Promise.reject(new Error("Labels are one volume."));
    await this.make({ files, bytes: labels.size, title: "", of, choose });
  }

  dispose(): void {
    this.running?.abort();
  }

  private show(heading: string, isChoice: boolean): void {
    setText(this.heading, heading);
    setText(this.note, "");
    this.note.setAttribute("role", "status");
    this.done.replaceChildren();
    this.choice.hidden = !isChoice;
    this.bar.hidden = true;
    setText(this.cancel, "Cancel");
    if (!this.element.open) this.element.showModal();
  }

  private close(): void {
    this.running?.abort();
    this.element.close();
  }

  private async bring(candidates: Promise<readonly Candidate[]>): Promise<void> {
    if (this.running !== undefined) return;
    try {
      const found = scanAmong(await candidates);
      await this.make({
        files: found.files,
        bytes: found.bytes,
        title: this.title.value.trim(),
        choose: (series, signal) => {
          this.bar.hidden = true;
          setText(this.note, "There are several series in it. Which is the CT of the wrist?");
          return askForSeries(this.series, series, signal).finally(() => {
            this.bar.hidden = false;
          });
        },
      });
    } catch (error) {
      this.complain(error);
    }
  }

  private async make(wish: NewCaseWish): Promise<void> {
    const running = new AbortController();
    this.running = running;
    this.choice.hidden = true;
    this.bar.hidden = false;
    this.bar.value = 0;
    setText(this.note, "Bringing it to the host…");
    try {
      const id = await makeNewCase(
        wish,
        (what, part) => {
          this.bar.value = part;
          setText(this.note, progressText(what, part));
        },
        running.signal,
      );
      this.bar.value = 1;
      setText(this.note, `The case is made. It is in the list as “${id}”.`);
      const look = make(
        "a.button-link",
        { href: `#/scan/${encodeURIComponent(id)}` },
        "Look at it",
      );
      look.addEventListener("click", () => {
        this.element.close();
      });
      this.done.replaceChildren(look);
      setText(this.cancel, "Close");
      this.made(id);
    } catch (error) {
      if (!running.signal.aborted) this.complain(error);
    } finally {
      this.running = undefined;
    }
  }

  private complain(error: unknown): void {
    this.bar.hidden = true;
    this.choice.hidden = this.heading.textContent !== "Add a scan";
    this.note.setAttribute("role", "alert");
    setText(this.note, error instanceof Error ? error.message : String(error));
  }
}
