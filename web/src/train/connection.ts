// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The room's line to its host: what is sent over it, and what is said while it does not hold.
import { HostLink, openPageSocket, pageWord, type LinkState } from "../host_link";
import type { CArmPicture, HandMessage, HostMessage, PageMessage } from "../protocol";

export interface ConnectionHandlers {
  /** @param text  what is said over the scene; empty while the line is open */
  onLink(state: LinkState, text: string): void;
  onMessage(message: HostMessage): void;
  onPicture(picture: CArmPicture): void;
  say(text: string): void;
}

const SEQUENCE_END = 0xffffffff;

function linkText(state: LinkState, why: string): string {
  switch (state) {
    case "busy":
      return `${why === "" ? "Another page operates here." : why} This page asks again by itself.`;
    case "lost":
      return "The connection is lost; the scene is frozen. Trying again by itself…";
    default:
      return "";
  }
}

/** A station that was given new links says what to do to whoever loads the page again. */
async function leaveWhereShutOut(): Promise<void> {
  const answer = await fetch("/api/procedures", { method: "HEAD" }).catch(() => undefined);
  if (answer?.status === 403) location.reload();
}

export class Connection {
  private readonly link: HostLink;
  private sequence = 0;

  constructor(private readonly handlers: ConnectionHandlers) {
    this.link = new HostLink(openPageSocket, pageWord(), {
      onState: (state, why) => {
        handlers.onLink(state, linkText(state, why));
        if (state === "lost") void leaveWhereShutOut();
      },
      onMessage: (message) => {
        handlers.onMessage(message);
      },
      onPicture: (picture) => {
        handlers.onPicture(picture);
      },
      onRefused: (reason) => {
        handlers.say(`Passed over a message that is none: ${reason}`);
      },
    });
  }

  /** Sends, or says that nothing was sent. @return whether it was sent */
  tell(message: PageMessage): boolean {
    const sent = this.link.send(message);
    if (!sent) this.handlers.say("Not connected: nothing was sent. Wait for the connection.");
    return sent;
  }

  /** Ends what another page does here. */
  endOther(): void {
    this.link.endOther();
  }

  /** Where the hand is: many times a second, hence silent while the line does not hold. */
  sendHand(hand: Omit<HandMessage, "type" | "sequence">): void {
    this.sequence = (this.sequence + 1) % SEQUENCE_END;
    this.link.send({ type: "hand", sequence: this.sequence, ...hand });
  }

  dispose(): void {
    this.link.dispose();
  }
}
