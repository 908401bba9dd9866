// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Coming in by the link that the station printed, as from a mail: from a page of another site.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";

/** The link that a station printed. */
export async function printedLink(station) {
  const until = Date.now() + 10_000;
  for (;;) {
    const [link] = /http\S+token=\S+/.exec(station.output.join("")) ?? [];
    if (link !== undefined) return link;
    if (Date.now() > until) throw new Error("the station printed no link");
    await new Promise((done) => setTimeout(done, 50));
  }
}

/** Shows a page of another site (localhost is another than 127.0.0.1) and follows its link. */
export async function followFromElsewhere(page, link) {
  const server = createServer((_, answer) => {
    answer.setHeader("Content-Type", "text/html");
    answer.end(`<!doctype html><title>mail</title><a href="${link}">here</a>`);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  try {
    await page.goto(`http://localhost:${server.address().port}/`);
    await page.click("a");
    await page.waitForURL(
      (url) => url.hostname === "127.0.0.1" && url.search === "",
    );
  } finally {
    server.closeAllConnections?.();
    server.close();
  }
}

/** For trainees: at a station for its own machine it stands beside the records alone. */
export function traineesLink(station) {
  const links = readFileSync(join(station.records, "attempts.links"), "utf8");
  const [, token] = /^trainee (\S+)$/m.exec(links) ?? [];
  if (token === undefined) throw new Error("there is no link for trainees");
  return `${station.url}/?token=${token}`;
}
