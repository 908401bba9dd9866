// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is to be read beside the round picture: where things are, how hard they press, which places were seen,
// and, while there is no joint to see, what to do next.
import { make, setText } from "../dom";
import { keyCap } from "../key_caps";
import type { ScopeMessage, SnapshotMessage } from "../protocol";
import { ForceGauge } from "./force_gauge";
import { forcesInJoint } from "./force_limits";
import { KEYS_IN_WORDS } from "./scope_keys";
import type { Plan } from "./scope_plan";
import type { ToolKind } from "./scope_tools";
import { scopeWords } from "./scope_words_model";

export interface ScopeSituation {
  readonly plan: Plan;
  readonly scope: ScopeMessage | undefined;
  readonly snapshot: SnapshotMessage | undefined;
  /** The hand that keys and mouse lead. */
  readonly moved: 0 | 1;
  /** It leads the other one. */
  readonly hasGamepad: boolean;
  /** The portal that the scope is held before. */
  readonly wanted: string;
  /** What works beside the scope. */
  readonly tool: ToolKind;
  /** What makes a portal, in the other hand; empty: nothing does. */
  readonly onSkin: string;
}

export class ScopeReadings {
  /** Beside the picture. */
  readonly column: HTMLElement;
  /** Over the picture. */
  readonly words: HTMLElement;
  private readonly where = make("strong");
  private readonly next = make("span");
  private readonly nextKeys = { pull: keyCap("{KeyW}"), in: keyCap("{KeyA}") };
  private readonly status = make("p.scope-status", { role: "status" });
  private readonly listTitle = make("h3.scope-points-title");
  private readonly list = make("ol.scope-points");
  private readonly gauge = new ForceGauge();
  /** Over the picture as well: that something presses too hard. */
  readonly press = this.gauge.over;

  constructor() {
    this.column = make(
      "div.scope-column",
      {},
      this.status,
      this.gauge.element,
      this.listTitle,
      this.list,
      make("p.scope-keys", {}, KEYS_IN_WORDS),
    );
    const { pull, in: into } = this.nextKeys;
    this.words = make(
      "p.scope-words",
      { role: "status" },
      this.where,
      make("span.scope-next", {}, this.next, " ", pull, into),
    );
  }

  show({ plan, scope, snapshot, moved, hasGamepad, wanted, tool, onSkin }: ScopeSituation): void {
    this.gauge.show(forcesInJoint(scope, snapshot), performance.now());
    const words = scopeWords(
      {
        portal: scope?.portals[0] ?? "",
        isInJoint: scope?.in_joint[0] === 1,
        isSlack: snapshot?.wrist.traction_n === 0,
      },
      wanted,
    );
    this.words.hidden = words.where === "";
    setText(this.where, words.where);
    setText(this.next, words.next);
    for (const key of ["pull", "in"] as const) this.nextKeys[key].hidden = words.key !== key;
    const where = (hand: 0 | 1): string => {
      const portal = scope?.portals[hand] ?? "";
      if (portal === "") return "outside";
      return scope?.in_joint[hand] === 1 ? `in the joint by ${portal}` : `in portal ${portal}`;
    };
    const isClosed = scope?.jaws_closed[1] === 1;
    const state = {
      probe: "",
      grasper: isClosed ? ", closed" : ", open",
      punch: isClosed ? ", closed" : ", open",
      shaver: scope?.running[1] === 1 ? ", running" : "",
    }[tool];
    setText(
      this.status,
      `Scope ${where(0)} · ` +
        (onSkin === "" ? `${tool} ${where(1)}${state}` : `${onSkin}: on the skin`) +
        ` · moving the ${moved === 0 ? "scope" : onSkin === "" ? tool : onSkin}` +
        (hasGamepad && onSkin === "" ? `, gamepad the ${moved === 0 ? tool : "scope"} · ` : " · ") +
        (tool === "grasper" ? `brought out ${scope?.loose_out ?? 0} · ` : "") +
        (plan.drill === null
          ? `seen ${scope?.points_seen.length ?? 0} of ${plan.points.length} · `
          : "") +
        `pull-outs ${scope?.pull_outs ?? 0} · generated, not seen in the CT`,
    );
  }

  /** Those of one joint, ticked off where they were seen. */
  showPoints(plan: Plan, scope: ScopeMessage | undefined, joint: string): void {
    this.list.hidden = this.listTitle.hidden = plan.drill !== null; // the exercises are the list
    const points = plan.points.filter((point) => point.joint === joint);
    const seen = points.filter((point) => scope?.points_seen.includes(point.number) ?? false);
    const name = joint.charAt(0).toUpperCase() + joint.slice(1);
    setText(this.listTitle, `${name} joint: ${seen.length} of ${points.length}`);
    this.list.replaceChildren(
      ...points.map((point) => {
        const isSeen = scope?.points_seen.includes(point.number) ?? false;
        const item = make("li", { title: point.found_by }, `${isSeen ? "✓ " : ""}${point.name}`);
        item.classList.toggle("is-seen", isSeen);
        return item;
      }),
    );
  }
}
