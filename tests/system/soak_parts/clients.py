# Copyright 2026 The Carpus authors
# SPDX-License-Identifier: Apache-2.0
"""Who comes to the station: a page that operates, and others who come, ask, misbehave and go."""

import http.client
import os
import random
import socket
import threading
import time

from .web_socket import WebSocket

EXERCISE_TICKS = 20_000


class Page(threading.Thread):
    """Operates at true speed, exercise after exercise; is killed now and then and comes back, as itself."""

    def __init__(self, port, protocol, seed):
        super().__init__(daemon=True)
        self.port, self.protocol, self.random = port, protocol, random.Random(seed)
        self.word = "soak" + str(seed)
        self.stopping = threading.Event()
        self.exercise_ticks = EXERCISE_TICKS
        self.lives_s = (5, 60)  # until it is killed, from and to
        self.end_with_finish = threading.Event()
        self.finished = 0
        self.deaths = 0
        self.went_on = 0
        self.rates = []         # ticks a second, over 5 s
        self.waits = []         # without the station [s]
        self.exercise = 0
        self.ticks = {}         # last tick seen, by exercise
        self.lost = []          # ticks that a kill of the station took

    def run(self):
        last_heard = time.monotonic()
        while not self.stopping.is_set():
            try:
                page = WebSocket(self.port)
                self.waits.append(time.monotonic() - last_heard)
                self.operate(page)
            except (ConnectionError, OSError, ValueError):
                time.sleep(0.1)
            last_heard = time.monotonic()

    def operate(self, page):
        page.say("hello", protocol=self.protocol, page=self.word)
        begun_at = None
        dies_at = time.monotonic() + self.random.uniform(*self.lives_s)
        rate_from = None
        next_hand = 0.0
        sequence = 0
        try:
            while not self.stopping.is_set():
                message = page.hear()
                now = time.monotonic()
                kind = message["type"] if message else "picture"
                if kind == "busy":
                    time.sleep(0.5)
                    page.say("hello", protocol=self.protocol, page=self.word)
                elif kind == "welcome":
                    if message["exercise"] and message["is_own"]:
                        self.went_on += message["exercise"] == self.exercise
                        self.exercise = message["exercise"]
                        page.say("pause", on=False)
                    else:
                        self.begin(page)
                    begun_at, rate_from = now, None
                elif kind == "score":
                    self.finished += 1
                    self.begin(page)
                    begun_at, rate_from = now, None
                elif kind == "snapshot" and begun_at is not None:
                    self.note(message)
                    if message["finished"]:
                        continue
                    if message["paused"]:
                        rate_from = None
                    elif rate_from is None:
                        rate_from = (now, message["tick"])
                    elif now - rate_from[0] > 5:
                        self.rates.append((message["tick"] - rate_from[1]) / (now - rate_from[0]))
                        rate_from = (now, message["tick"])
                    if now >= next_hand:
                        sequence += 1
                        self.move(page, sequence)
                        next_hand = now + 1 / 60
                    is_done = message["tick"] > self.exercise_ticks or self.end_with_finish.is_set()
                    if is_done and now > begun_at + 1:
                        page.say("act", id="finish")
                        begun_at = now
                    if now > dies_at:
                        self.deaths += 1
                        return page.vanish()
        finally:
            page.close()

    def begin(self, page):
        page.say("start", trainee="soak", procedure="dorsal_scaphoid_fixation", input_device="mouse", seed=self.random.randrange(1 << 32))

    def note(self, state):
        # The number of an exercise comes with welcome; ticks only grow, but where a killed station lost some.
        before = self.ticks.get(self.exercise, 0)
        if state["tick"] < before:
            self.lost.append(before - state["tick"])
        self.ticks[self.exercise] = state["tick"]

    def move(self, page, sequence):
        hand = sequence % 2
        tip = [self.random.uniform(-60, 60) for _ in range(3)]
        page.say("hand", sequence=sequence, hand=hand, tip_mm=tip, shaft=[0.0, 0.6, 0.8], thrust_n=self.random.uniform(0, 30),
                 driver=self.random.choice(["off", "forward"]), guidance="planned")
        what = self.random.random()
        if what < 0.01:
            page.say("take_shot", rotation_deg=self.random.uniform(-90, 90), tilt_deg=0.0, reference="held_forearm")
        elif what < 0.03:
            page.say("pedal", down=self.random.random() < 0.5)
        elif what < 0.04:
            page.say("act", id=self.random.choice(["undo", "put_down"]), hand=hand)
        elif what < 0.05:
            page.say("act", id="take", hand=hand, instrument=self.random.choice(["guide_wire", "probe", "depth_gauge"]))
        elif what < 0.08:
            page.say("wrist", flexion_deg=self.random.uniform(-60, 60), radial_deviation_deg=0.0, pronation_deg=0.0, traction_n=0.0)


class Visitors(threading.Thread):
    """Others: well behaved, rude and broken, a few a second."""

    def __init__(self, port, protocol, seed):
        super().__init__(daemon=True)
        self.port, self.protocol, self.random = port, protocol, random.Random(seed)
        self.stopping = threading.Event()
        self.counts = {}
        self.answers = []       # of well behaved requests [s]
        self.unanswered = 0     # of them, while the station was up
        self.is_down = threading.Event()
        self.kills = 0          # of the station so far

    def run(self):
        deeds = (self.reads, self.half_request, self.garbage, self.busy_page, self.silent, self.bad_frames, self.leaves_while_reading)
        while not self.stopping.is_set():
            deed = self.random.choice(deeds)
            self.counts[deed.__name__] = self.counts.get(deed.__name__, 0) + 1
            kills = self.kills
            try:
                deed()
            except (ConnectionError, OSError, http.client.HTTPException, ValueError):
                self.unanswered += deed == self.reads and not self.is_down.is_set() and kills == self.kills
            time.sleep(self.random.uniform(0.05, 0.4))

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=10)

    def reads(self):
        target = self.random.choice(["/", "/api/case", "/api/procedures", "/api/instruments", "/api/attempts", "/api/scene.glb", "/nothing"])
        began = time.monotonic()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        try:
            connection.request("GET", target)
            connection.getresponse().read()
            self.answers.append(time.monotonic() - began)
        finally:
            connection.close()

    def half_request(self):
        with self.connect() as stream:
            stream.sendall(b"GET /api/case HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nX-Half: " % self.port)
            time.sleep(self.random.uniform(0, 0.3))

    def garbage(self):
        with self.connect() as stream:
            stream.sendall(os.urandom(self.random.randrange(1, 4000)))

    def busy_page(self):
        page = WebSocket(self.port, timeout=10)
        page.say("hello", protocol=self.protocol, page=f"other{self.random.random()}")
        page.hear()
        page.say("hand", sequence=1, hand=1, tip_mm=[0.0, 0.0, 0.0], shaft=[0.0, 0.0, 1.0], thrust_n=0.0, driver="forward", guidance="direct")
        page.vanish() if self.random.random() < 0.5 else page.close()

    def silent(self):
        with self.connect():
            time.sleep(self.random.uniform(0, 0.5))

    def bad_frames(self):
        page = WebSocket(self.port, timeout=10)
        page.stream.sendall(os.urandom(self.random.randrange(2, 300)))
        page.vanish()

    def leaves_while_reading(self):
        with self.connect() as stream:
            stream.sendall(b"GET /api/scene.glb HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" % self.port)
            stream.recv(1000)
