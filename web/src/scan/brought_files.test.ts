// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
import { BlobWriter, BlobReader, ZipWriter } from "@zip.js/zip.js";
import { describe, expect, it } from "vitest";
import { fromFiles } from "./brought_files";

const CENTRAL = 0x02014b50;
const LOCAL = 0x04034b50;
const SIZE_IN_CENTRAL = 24;
const SIZE_IN_LOCAL = 22;

async function zipOf(name: string, content: Blob): Promise<Uint8Array> {
  const writer = new ZipWriter(new BlobWriter(), { useWebWorkers: false, dataDescriptor: false });
  await writer.add(name, new BlobReader(content));
  return new Uint8Array(await (await writer.close()).arrayBuffer());
}

/** The same archive, saying that its one file is `bytes` long. */
function saying(zip: Uint8Array, bytes: number): Uint8Array {
  const view = new DataView(zip.buffer);
  for (let at = 0; at + 46 <= zip.length; at += 1) {
    if (view.getUint32(at, true) === CENTRAL) view.setUint32(at + SIZE_IN_CENTRAL, bytes, true);
    if (view.getUint32(at, true) === LOCAL) view.setUint32(at + SIZE_IN_LOCAL, bytes, true);
  }
  return zip;
}

const fileOf = (zip: Uint8Array, name = "scan.zip"): File =>
  new File([new Uint8Array(zip)], name, { type: "application/zip" });

describe("a zip that is brought", () => {
  it("is what it holds", async () => {
    const [one, ...others] = await fromFiles([
      fileOf(await zipOf("series/1.dcm", new Blob(["slice"]))),
    ]);
    expect(others).toEqual([]);
    expect(one).toMatchObject({ name: "series/1.dcm", bytes: 5 });
    expect(await (await one?.read())?.text()).toBe("slice");
  });

  it("that unpacks to far more than it says is given up where it exceeds that", async () => {
    const bomb = await zipOf("1.dcm", new Blob([new Uint8Array(64 * 2 ** 20)]));
    expect(bomb.length).toBeLessThan(2 ** 20);
    const [one] = await fromFiles([fileOf(saying(bomb, 1000))]);
    expect(one?.bytes).toBe(1000);
    await expect(one?.read()).rejects.toThrow("scan.zip cannot be unpacked");
  });

  it("whose content is another than its checksum says is refused", async () => {
    const zip = await zipOf("1.dcm", new Blob(["0123456789".repeat(100)]));
    const inData = 60;
    zip[inData] = (zip[inData] ?? 0) ^ 0x10;
    const read = fromFiles([fileOf(zip)]).then(([one]) => one?.read());
    await expect(read).rejects.toThrow("scan.zip cannot be unpacked");
  });

  it("that is none is refused by its name", async () => {
    await expect(fromFiles([fileOf(new TextEncoder().encode("no zip"))])).rejects.toThrow(
      "scan.zip cannot be unpacked",
    );
  });
});
