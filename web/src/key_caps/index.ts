// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is printed on the keys that the page names.
export { followLayout, keyCap, nameShortcut, withKeys } from "./key_caps";
