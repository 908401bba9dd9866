// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lets another case be chosen, or takes the one that the address wants, and goes with the host where
// it has opened another.
import { fetchCases, mayPrepareCases, nextForWanted, titleAmong, wantedCase } from "../case_data";
import { PathologyDialog } from "../pathology";
import type { CaseList, PageMessage } from "../protocol";
import type { StartDialog } from "../start_dialog";

const OPENING = "Opening the case…";
const NOT_OPENED = "That case could not be opened; this one stays.";

export interface CaseChoiceRoom {
  readonly start: StartDialog;
  tell(message: PageMessage): boolean;
  /** An operation does, or waits, which another case would end. */
  runs(): boolean;
}

export class CaseChoice {
  /** Id of the case that is shown; unknown until `offer`. */
  private open: string | undefined;
  /** Another was asked for, and the host is away to open it. */
  private isOpening = false;

  constructor(private readonly room: CaseChoiceRoom) {}

  offer(list: CaseList): void {
    this.open = list.open;
    this.room.start.showCases(list, (id) => {
      forgetWanted(); // who chooses by hand wants nothing else any more
      this.choose(id);
    });
    void this.offerPathology(list);
  }

  /** The host is there, maybe again. */
  async follow(): Promise<void> {
    let list: CaseList;
    try {
      list = await fetchCases();
    } catch {
      return; // the host goes and comes; its next welcome asks again
    }
    if (this.open !== undefined && list.open !== this.open) return location.reload();
    if (this.isOpening) return this.refuse(NOT_OPENED);
    this.followAddress(list);
  }

  /** Why the host does not answer. @param why  where it is for no case */
  whyAway(why: string): string {
    return this.isOpening ? OPENING : why;
  }

  /** The host refused something: if it was the case, it stays where it is. */
  refused(): void {
    if (this.isOpening) this.refuse(NOT_OPENED);
  }

  /** To instructors: a trainee's page is not even told whether there is one. */
  private async offerPathology(list: CaseList): Promise<void> {
    const open = list.cases.find((one) => one.id === list.open);
    const may = await mayPrepareCases().catch(() => false);
    if (open === undefined || !may) return;
    this.room.start.offerPathology(() => {
      new PathologyDialog().open(open.id, titleAmong(open, list.cases));
    });
  }

  private followAddress(list: CaseList): void {
    const next = nextForWanted(list, wantedCase(location.hash), this.room.runs());
    switch (next.what) {
      case "nothing":
        return;
      case "go":
        if (next.hash === "") forgetWanted();
        else location.replace(next.hash);
        return;
      case "choose":
        this.choose(next.id);
        return;
      case "say":
        forgetWanted();
        this.room.start.setReady(true, next.text);
    }
  }

  private choose(id: string): void {
    if (this.isOpening || !this.room.tell({ type: "choose_case", case: id })) return;
    this.isOpening = true;
    this.room.start.setReady(false, OPENING);
  }

  private refuse(why: string): void {
    this.isOpening = false;
    forgetWanted();
    this.room.start.setReady(true, why);
  }
}

/** What the address wanted is done, or given up: a reload does not want it again. */
function forgetWanted(): void {
  if (wantedCase(location.hash) !== undefined) history.replaceState(null, "", "#/");
}
