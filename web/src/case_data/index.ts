// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the host tells about the case, its procedures and past attempts over HTTP.
export * from "./case_client";
export * from "./case_titles_model";
export * from "./wanted_case_model";
export { inOrder } from "./grade_order";
export { sentence } from "./sentence";
