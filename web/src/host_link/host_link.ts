// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One WebSocket to the host: says hello, checks all that arrives, and comes back by itself when the
// connection is lost. It never throws on what the network brings.
import {
  parseCArmPicture,
  parseHostMessage,
  PROTOCOL_VERSION,
  serialize,
  type CArmPicture,
  type HostMessage,
  type PageMessage,
} from "../protocol";

export type LinkState = "connecting" | "open" | "busy" | "lost";

export interface LinkHandlers {
  onState(state: LinkState, why: string): void;
  onMessage(message: HostMessage): void;
  onPicture(picture: CArmPicture): void;
  /** A frame that is none of the protocol's; the exercise goes on without it. */
  onRefused(reason: string): void;
}

/** What of a WebSocket is used here, so that tests can stand in for one. */
export interface Socket {
  binaryType: BinaryType;
  readonly readyState: number;
  onopen: ((event: Event) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
  onmessage: ((event: MessageEvent) => void) | null;
  send(text: string): void;
  close(): void;
}

const FIRST_RETRY_MS = 500;
const LONGEST_RETRY_MS = 5000;
const BUSY_RETRY_MS = 1500;
const OPEN = 1;

export class HostLink {
  private socket: Socket | undefined;
  private retryMs = FIRST_RETRY_MS;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private closed = false;
  private state: LinkState = "connecting";

  constructor(
    private readonly makeSocket: () => Socket,
    private readonly word: string,
    private readonly handlers: LinkHandlers,
  ) {
    this.connect();
  }

  /** Whether the message went out. */
  send(message: PageMessage): boolean {
    if (this.socket?.readyState !== OPEN || this.state !== "open") return false;
    this.socket.send(serialize(message));
    return true;
  }

  /** Asks again at once, after `busy` or while a connection is lost. */
  retryNow(): void {
    if (this.state === "busy" && this.socket?.readyState === OPEN) this.sayHello();
    else if (this.state !== "open") this.connect();
  }

  /** While another page operates: ends what it does and asks for the seat. */
  endOther(): void {
    if (this.state !== "busy" || this.socket?.readyState !== OPEN) return;
    this.socket.send(serialize({ type: "end" }));
    this.sayHello();
  }

  dispose(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.drop();
  }

  private connect(): void {
    clearTimeout(this.timer);
    this.drop();
    const socket = this.makeSocket();
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.sayHello();
    };
    socket.onmessage = (event) => {
      this.receive(event.data);
    };
    socket.onclose = (event) => {
      this.lose(event.reason);
    };
  }

  private drop(): void {
    if (this.socket === undefined) return;
    this.socket.onopen = this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.socket = undefined;
  }

  private sayHello(): void {
    this.socket?.send(serialize({ type: "hello", protocol: PROTOCOL_VERSION, page: this.word }));
  }

  private receive(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      const picture = parseCArmPicture(data);
      if (picture.ok) this.handlers.onPicture(picture.value);
      else this.handlers.onRefused(picture.reason);
      return;
    }
    const message = parseHostMessage(typeof data === "string" ? data : "");
    if (!message.ok) {
      this.handlers.onRefused(message.reason);
      return;
    }
    if (message.value.type === "welcome") {
      this.retryMs = FIRST_RETRY_MS;
      this.enter("open", "");
    } else if (message.value.type === "busy") {
      this.enter("busy", message.value.reason);
      this.again(BUSY_RETRY_MS);
    }
    this.handlers.onMessage(message.value);
  }

  private lose(why: string): void {
    if (this.closed) return;
    if (this.state !== "busy") this.enter("lost", why);
    this.again(this.state === "busy" ? BUSY_RETRY_MS : this.retryMs);
    this.retryMs = Math.min(LONGEST_RETRY_MS, this.retryMs * 2);
  }

  private again(afterMs: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.retryNow();
    }, afterMs);
  }

  private enter(state: LinkState, why: string): void {
    this.state = state;
    this.handlers.onState(state, why);
  }
}

const WORD_KEY = "carpus.page";

/** What this tab says in each hello, after a reload too: the host keeps its seat for it. */
export function pageWord(): string {
  const word = Array.from(crypto.getRandomValues(new Uint32Array(4)), (n) => n.toString(16)).join(
    "-",
  );
  try {
    const known = sessionStorage.getItem(WORD_KEY);
    if (known !== null) return known;
    sessionStorage.setItem(WORD_KEY, word);
  } catch {
    // storage may be forbidden; the word then holds until the page is left
  }
  return word;
}

/** The host that served this page. */
export function openPageSocket(): Socket {
  const scheme = location.protocol === "https:" ? "wss:" : "ws:";
  return new WebSocket(`${scheme}//${location.host}/ws`);
}
