// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How somebody learns.
export { mountReview } from "./review_page";
