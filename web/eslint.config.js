// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Beside the usual rules: a feature is entered through its index.ts only, and what is listed as
// pure imports neither three.js nor the DOM.
import js from "@eslint/js";
import tseslint from "typescript-eslint";

const notThroughTheDoor = {
  regex: "^\\.\\./[a-z_]+/(?!index$)",
  message: "Enter a feature through its index.ts.",
};
const pure = [
  "src/frames/patient_to_renderer.ts",
  "src/protocol/**",
  "src/tool_placement/**",
  "src/operation/**",
  "src/bone_shading/**",
  "src/theatre/instrument_set.ts",
  "src/**/*_model.ts",
];

export default tseslint.config(
  {
    ignores: [
      "dist",
      "node_modules",
      "src/protocol/generated.ts",
      "src/protocol/generated_rules.ts",
    ],
  },
  js.configs.recommended,
  ...tseslint.configs.strict,
  {
    rules: {
      "no-restricted-imports": ["error", { patterns: [notThroughTheDoor] }],
      "@typescript-eslint/no-non-null-assertion": "error",
    },
  },
  {
    files: ["*.js", "**/*.mjs"],
    languageOptions: { globals: { process: "readonly", console: "readonly" } },
  },
  {
    files: pure,
    rules: {
      "no-restricted-imports": [
        "error",
        { paths: ["three"], patterns: [notThroughTheDoor, { regex: "^three/" }] },
      ],
      "no-restricted-globals": ["error", "document", "window", "navigator", "localStorage"],
    },
  },
);
