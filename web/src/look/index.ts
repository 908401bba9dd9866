// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One look for all pages.
import "@fontsource-variable/inter/index.css";
import "./tokens.css";
import "./base.css";
import "./page.css";
