// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Entry of the page: which room the address names.
//   #/               operate; #/?case=easy&then=replay/12 on that case, and then there
//   #/attempts       past attempts
//   #/attempts/12    the score of one
//   #/replay/12      an attempt looked at again; #/replay/12/15 two; ?t=93.5 from that second
//   #/review         learning curves
//   #/views          the view quiz
//   #/scan           the open case's scan; #/scan/easy another's
import "./look";
import { mountAttempts } from "./attempts_list";
import { mountReplay } from "./replay";
import { mountReview } from "./review";
import { mountScan } from "./scan";
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
  const replay = /^#\/replay\/(\d+)(?:\/(\d+))?(?:\?t=([\d.]+))?$/.exec(location.hash);
  const scan = /^#\/scan(?:\/([^/?]+))?$/.exec(location.hash);
  if (replay !== null) {
    const ids = replay.slice(1, 3).filter((id) => id !== undefined);
    leave = mountReplay(app, ids.map(Number), Number(replay[3] ?? 0));
  } else if (attempt !== undefined) leave = mountScore(app, Number(attempt));
  else if (location.hash === "#/attempts") leave = mountAttempts(app);
  else if (location.hash === "#/review") leave = mountReview(app);
  else if (/^#\/views(\?|$)/.test(location.hash)) leave = mountViewQuiz(app);
  else if (scan !== null) leave = mountScan(app, scan[1] && decodeURIComponent(scan[1]));
  else leave = mountTrain(app);
}

window.addEventListener("hashchange", route);
route();
