// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the network may bring does not stop the page: broken frames, a lost host, a busy host.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { PROTOCOL_VERSION } from "../protocol";
import { HostLink, type LinkHandlers, type Socket } from "./host_link";

class FakeSocket implements Socket {
  binaryType: BinaryType = "blob";
  readyState = 0;
  onopen: ((event: Event) => void) | null = null;
  onclose: ((event: CloseEvent) => void) | null = null;
  onmessage: ((event: MessageEvent) => void) | null = null;
  readonly sent: string[] = [];
  send(text: string): void {
    this.sent.push(text);
  }
  close(): void {
    this.readyState = 3;
  }
  open(): void {
    this.readyState = 1;
    this.onopen?.({} as Event);
  }
  bring(data: unknown): void {
    this.onmessage?.({ data } as MessageEvent);
  }
  lose(): void {
    this.readyState = 3;
    this.onclose?.({ reason: "" } as CloseEvent);
  }
}

const welcome = JSON.stringify({
  type: "welcome",
  protocol: PROTOCOL_VERSION,
  program: "carpus",
  exercise: 0,
  trainee: "",
  started_at: "",
  is_own: false,
});

describe("HostLink", () => {
  let sockets: FakeSocket[];
  let handlers: { [K in keyof LinkHandlers]: ReturnType<typeof vi.fn> };
  let link: HostLink;
  const last = (): FakeSocket => {
    const socket = sockets.at(-1);
    if (socket === undefined) throw new Error("no socket was opened");
    return socket;
  };

  beforeEach(() => {
    vi.useFakeTimers();
    sockets = [];
    handlers = { onState: vi.fn(), onMessage: vi.fn(), onPicture: vi.fn(), onRefused: vi.fn() };
    link = new HostLink(
      () => {
        sockets.push(new FakeSocket());
        return last();
      },
      "word",
      handlers,
    );
  });
  afterEach(() => {
    link.dispose();
    vi.useRealTimers();
  });

  it("says hello first and sends nothing else before the welcome", () => {
    expect(link.send({ type: "pause", on: true })).toBe(false);
    last().open();
    expect(JSON.parse(last().sent[0] ?? "")).toEqual({
      type: "hello",
      protocol: PROTOCOL_VERSION,
      page: "word",
    });
    expect(link.send({ type: "pause", on: true })).toBe(false);
    last().bring(welcome);
    expect(link.send({ type: "pause", on: true })).toBe(true);
  });

  it("says the same word when it comes again", () => {
    last().open();
    last().lose();
    vi.advanceTimersByTime(500);
    last().open();
    expect(sockets.map((s) => s.sent[0])).toEqual(Array(2).fill(sockets[0]?.sent[0]));
  });

  it.each(["", "{", "[]", '{"type":"snapshot"}', '{"type":"nonsense"}', new ArrayBuffer(5), 7])(
    "refuses %j and goes on",
    (data) => {
      last().open();
      last().bring(data);
      expect(handlers.onRefused).toHaveBeenCalledOnce();
      last().bring(welcome);
      expect(handlers.onState).toHaveBeenLastCalledWith("open", "");
    },
  );

  it("comes back after a loss, ever more slowly, and says so", () => {
    last().open();
    last().bring(welcome);
    last().lose();
    expect(handlers.onState).toHaveBeenLastCalledWith("lost", "");
    expect(link.send({ type: "pause", on: true })).toBe(false);
    vi.advanceTimersByTime(500);
    expect(sockets.length).toBe(2);
    last().lose();
    vi.advanceTimersByTime(900);
    expect(sockets.length).toBe(2);
    vi.advanceTimersByTime(200);
    expect(sockets.length).toBe(3);
  });

  it("waits while another page operates, then gets in", () => {
    last().open();
    last().bring(JSON.stringify({ type: "busy", reason: "another page operates", may_end: true }));
    expect(handlers.onState).toHaveBeenLastCalledWith("busy", "another page operates");
    last().lose();
    expect(handlers.onState).toHaveBeenLastCalledWith("busy", "another page operates");
    vi.advanceTimersByTime(3000);
    expect(sockets.length).toBe(2);
    last().open();
    last().bring(welcome);
    expect(handlers.onState).toHaveBeenLastCalledWith("open", "");
  });

  it("ends another's operation while that keeps it waiting, and asks for the seat", () => {
    last().open();
    link.endOther();
    last().bring(JSON.stringify({ type: "busy", reason: "", may_end: true }));
    link.endOther();
    const types = last().sent.map((text) => (JSON.parse(text) as { type: string }).type);
    expect(types).toEqual(["hello", "end", "hello"]);
  });

  it("opens nothing more once disposed", () => {
    last().open();
    link.dispose();
    vi.advanceTimersByTime(60000);
    expect(sockets.length).toBe(1);
  });
});
