// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Build and tests of the page. In development `npm run dev` passes what the page asks for to a
// `carpus serve` on its usual port.
import { defineConfig } from "vitest/config";

const host = process.env["CARPUS_HOST"] ?? "127.0.0.1:8080";

export default defineConfig({
  base: "/",
  build: {
    target: "es2022",
    assetsInlineLimit: 0,
    // three.js alone is larger than the default warning limit of 500 kB.
    chunkSizeWarningLimit: 900,
  },
  server: {
    host: "127.0.0.1",
    proxy: {
      "/api": { target: `http://${host}`, changeOrigin: true },
      "/ws": { target: `ws://${host}`, ws: true, changeOrigin: true, rewriteWsOrigin: true },
    },
  },
  test: { include: ["src/**/*.test.ts"], environment: "node" },
});
