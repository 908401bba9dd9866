// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lets another case be chosen, or takes the one that the address wants, and goes with the host where
// it has opened another.
import { fetchCases, wantedCase } from "../case_data";
import type { CaseList, PageMessage } from "../protocol";
import type { StartDialog } from "../start_dialog";

const OPENING = "Opening the case…";

export class CaseChoice {
  /** Id of the case that is shown; unknown until `offer`. */
  private open: string | undefined;
  /** Another was asked for, and the host is away to open it. */
  private isOpening = false;
  /** What the address wants is asked for once: a case that cannot be opened is no loop. */
  private hasAskedForWanted = false;

  constructor(
    private readonly start: StartDialog,
    private readonly tell: (message: PageMessage) => boolean,
  ) {}

  offer(list: CaseList): void {
    this.open = list.open;
    this.start.showCases(list, (id) => {
      this.choose(id);
    });
  }

  /** The host is there, maybe again. @param runs  an exercise does, which another case would end */
  async follow(runs: boolean): Promise<void> {
    let list: CaseList;
    try {
      list = await fetchCases();
    } catch {
      return; // the host goes and comes; its next welcome asks again
    }
    if (this.open !== undefined && list.open !== this.open) return location.reload();
    if (this.isOpening) {
      this.isOpening = false;
      this.start.setReady(true, "That case could not be opened; this one stays.");
    }
    this.followAddress(list, runs);
  }

  /** Why the host does not answer. @param why  where it is for no case */
  whyAway(why: string): string {
    return this.isOpening ? OPENING : why;
  }

  private followAddress(list: CaseList, runs: boolean): void {
    const wanted = wantedCase(location.hash);
    if (wanted === undefined || this.hasAskedForWanted) return;
    if (list.open === wanted.id) {
      if (wanted.then !== "") location.replace(wanted.then);
      return;
    }
    if (runs) return; // what is being done here is not ended by an address
    this.hasAskedForWanted = true;
    this.choose(wanted.id);
  }

  private choose(id: string): void {
    if (this.isOpening || !this.tell({ type: "choose_case", case: id })) return;
    this.isOpening = true;
    this.start.setReady(false, OPENING);
  }
}
