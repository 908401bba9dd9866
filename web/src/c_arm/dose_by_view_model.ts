// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What each view has cost: the host tells the dose in all, and what it grew by belongs to where the C-arm
// stands.
export interface ViewDose {
  readonly view: string;
  readonly cGyCm2: number;
}

export class DoseByView {
  private readonly doses = new Map<string, number>();
  private total = 0;

  /** A page that came back begins with what was there before. */
  see(totalCGyCm2: number, view: string): void {
    const more = totalCGyCm2 - this.total;
    this.total = totalCGyCm2;
    if (more > 0) this.doses.set(view, (this.doses.get(view) ?? 0) + more);
  }

  clear(): void {
    this.doses.clear();
    this.total = 0;
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
