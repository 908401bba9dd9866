// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Entry of the page: which room the address names.
//   #/               operate
//   #/attempts       past attempts
//   #/attempts/12    the score of one
//   #/review         learning curves
//   #/views          the view quiz
import "./look";
import { mountAttempts } from "./attempts_list";
import { mountReview } from "./review";
import { mountScore } from "./score_report";
import { mountTrain } from "./train";
import { mountViewQuiz } from "./view_quiz";

const app = document.getElementById("app");
let leave: () => void = () => undefined;

function route(): void {
  if (app === null) return;
  leave();
  window.scrollTo(0, 0);
  const attempt = /^#\/attempts\/(\d+)$/.exec(location.hash)?.[1];
  if (attempt !== undefined) leave = mountScore(app, Number(attempt));
  else if (location.hash === "#/attempts") leave = mountAttempts(app);
  else if (location.hash === "#/review") leave = mountReview(app);
  else if (/^#\/views(\?|$)/.test(location.hash)) leave = mountViewQuiz(app);
  else leave = mountTrain(app);
}

window.addEventListener("hashchange", route);
route();
