// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What each view has cost: the host tells the dose in all, and what it grew by belongs to where the C-arm
// stands.
export interface ViewDose {
  readonly view: string;
  readonly cGyCm2: number;
}

const EARLIER = "earlier";

export class DoseByView {
  private readonly doses = new Map<string, number>();
  private total: number | undefined;

  /** A page that came back does not know where from what was there before it came. */
  see(totalCGyCm2: number, view: string): void {
    const from = this.total === undefined ? EARLIER : view;
    const more = totalCGyCm2 - (this.total ?? 0);
    this.total = totalCGyCm2;
    if (more > 0) this.doses.set(from, (this.doses.get(from) ?? 0) + more);
  }

  clear(): void {
    this.doses.clear();
    this.total = undefined;
  }

  /** In the order in which they were first looked at. */
  get list(): readonly ViewDose[] {
    return [...this.doses].map(([view, cGyCm2]) => ({ view, cGyCm2 }));
  }
}

/** "PA 1.0, LAT 0.5"; nothing before the first. */
export function dosesText(list: readonly ViewDose[]): string {
  return list.map(({ view, cGyCm2 }) => `${view} ${cGyCm2.toFixed(1)}`).join(", ");
}
