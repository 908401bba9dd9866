// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which case a version was made of, as long as this browser remembers: the way back when a run made it
// worse. Both stay whole on the host.
const KEY = "carpus.versions";
const MOST = 200;

type Versions = Readonly<Record<string, string>>;

function remembered(store: Storage): Versions {
  try {
    const json: unknown = JSON.parse(store.getItem(KEY) ?? "{}");
    return typeof json === "object" && json !== null ? (json as Versions) : {};
  } catch {
    return {};
  }
}

export function rememberVersion(version: string, of: string, store: Storage = localStorage): void {
  const others = Object.entries(remembered(store)).filter(([one]) => one !== version);
  const kept = others.slice(1 - MOST);
  try {
    store.setItem(KEY, JSON.stringify({ ...Object.fromEntries(kept), [version]: of }));
  } catch {
    // A browser that keeps nothing has no way back; the list has.
  }
}

/** @param known  the cases that there are */
export function earlierVersion(
  version: string,
  known: readonly string[],
  store: Storage = localStorage,
): string | undefined {
  const of = remembered(store)[version];
  return typeof of === "string" && of !== version && known.includes(of) ? of : undefined;
}
