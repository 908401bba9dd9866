// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Starts the real `carpus serve` on a free port with records of its own, and stops it.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const START_MS = 60_000;

function freePort() {
  return new Promise((done, fail) => {
    const server = createServer();
    server.once("error", fail);
    server.listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => done(port));
    });
  });
}

function need(path, how) {
  if (!existsSync(path)) throw new Error(`${path} is not there. ${how}`);
  return path;
}

export function demoCase() {
  return need(
    process.env.CARPUS_CASE ?? join(root, "build/system/demo"),
    "Make it with tests/system/end_to_end, or set CARPUS_CASE to a case folder.",
  );
}

export function program() {
  return need(
    process.env.CARPUS_BIN ?? join(root, "build/release/bin/carpus"),
    "Build it with ./run --build-only, or set CARPUS_BIN.",
  );
}

/**
 * @param options  of `carpus serve` besides; --open unless the link is what is tried
 * @param where  a case folder, or a folder of them, in place of the demo's
 * @param fill  puts attempts into the records, whose file it is given, before anybody looks
 * @return {url, caseFolder, output, records, plugIn, stop}
 */
export async function startStation(options = ["--open"], where, fill) {
  const caseFolder = where ?? demoCase();
  const page = need(
    join(root, "web/dist"),
    "Build the page with: npm --prefix web run build",
  );
  const records = mkdtempSync(join(tmpdir(), "carpus-browser-"));
  fill?.(program(), caseFolder, join(records, "attempts.sqlite"));
  const port = await freePort();
  // Devices and calibrations of its own: none of whoever runs this.
  const env = {
    ...process.env,
    XDG_CONFIG_HOME: records,
    XDG_RUNTIME_DIR: records,
  };
  const output = [];
  const child = spawn(
    program(),
    [
      "serve",
      "--case",
      caseFolder,
      "--records",
      join(records, "attempts.sqlite"),
    ].concat(["--web", page, "--port", String(port)], options),
    { stdio: ["ignore", "pipe", "pipe"], env },
  );
  let ended = false;
  child.on("exit", () => (ended = true));
  for (const stream of [child.stdout, child.stderr])
    stream.on("data", (text) => output.push(text));
  const url = `http://127.0.0.1:${port}`;
  const until = Date.now() + START_MS;
  for (;;) {
    if (ended || Date.now() > until) {
      throw new Error(`carpus serve did not start:\n${output.join("")}`);
    }
    const answer = await fetch(`${url}/api/case`).catch(() => undefined);
    if (answer?.ok || answer?.status === 403) break;
    await new Promise((done) => setTimeout(done, 200));
  }
  return {
    url,
    caseFolder,
    output,
    records,
    /** A simulated arm that is plugged in. @return {unplug} */
    async plugIn() {
      const arm = spawn(program(), ["device", "simulate", "--unit", "7"], {
        stdio: ["ignore", "pipe", "ignore"],
        env,
      });
      await new Promise((done) => arm.stdout.once("data", done));
      return {
        unplug: () =>
          new Promise((done) => {
            arm.once("exit", done);
            arm.kill("SIGTERM");
          }),
      };
    },
    async stop() {
      if (!ended) {
        const gone = new Promise((done) => child.once("exit", done));
        child.kill("SIGTERM");
        const timer = setTimeout(() => child.kill("SIGKILL"), 10_000);
        await gone;
        clearTimeout(timer);
      }
      rmSync(records, { recursive: true, force: true });
    },
  };
}
