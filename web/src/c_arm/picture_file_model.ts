// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a saved picture is called: who, which shot, which view; what no file system takes is left out.

export function pictureFileName(patient: string, shot: number, view: string): string {
  const plain = (text: string): string =>
    text
      .replace(/°/g, "")
      .replace(/−/g, "-")
      .replace(/[^\p{L}\p{N}+-]+/gu, "_")
      .replace(/^_+|_+$/g, "");
  return `${plain(patient)}_shot_${shot}_${plain(view)}.png`;
}
