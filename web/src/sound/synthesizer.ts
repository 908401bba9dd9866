// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The sounds themselves, made of oscillators and noise: nothing is loaded.
import type { Sounds } from "./sound_model";

const MOTOR_GAIN = 0.1;
const BEEP_GAIN = 0.06;
const CLICK_GAIN = 0.22;
const KNOCK_GAIN = 0.16;
const KNOCK_HZ = 190;
const KNOCK_S = 0.07;
const BEEP_HZ = 1480;
const BEEP_S = 0.09;
const BEEP_EVERY_S = 0.32;
const SHOT_S = 0.22;
/** No step is heard as one [s]. */
const SMOOTH_S = 0.02;

export class Synthesizer {
  private readonly motor: OscillatorNode;
  private readonly whine: OscillatorNode;
  private readonly motorGain: GainNode;
  private readonly tone: BiquadFilterNode;
  private readonly noise: AudioBuffer;
  private nextBeepS = 0;

  constructor(private readonly context: AudioContext) {
    this.motorGain = context.createGain();
    this.motorGain.gain.value = 0;
    this.tone = context.createBiquadFilter();
    this.tone.type = "lowpass";
    this.tone.frequency.value = 1400;
    this.motor = context.createOscillator();
    this.motor.type = "sawtooth";
    this.whine = context.createOscillator();
    this.whine.type = "triangle";
    for (const source of [this.motor, this.whine]) {
      source.connect(this.tone);
      source.start();
    }
    this.tone.connect(this.motorGain).connect(context.destination);
    this.noise = context.createBuffer(1, Math.ceil(0.03 * context.sampleRate), context.sampleRate);
    const samples = this.noise.getChannelData(0);
    // Fades at once: the tick of a ratchet.
    for (let i = 0; i < samples.length; ++i)
      samples[i] = (2 * Math.random() - 1) * Math.exp(-i / (0.004 * context.sampleRate));
  }

  play({ beeps, clicks, knock, load, motorHz, shot, tightness }: Sounds): void {
    const now = this.context.currentTime;
    const runs = motorHz > 0;
    if (runs) {
      this.motor.frequency.setTargetAtTime(motorHz, now, SMOOTH_S);
      this.whine.frequency.setTargetAtTime(3.02 * motorHz, now, SMOOTH_S);
      this.tone.frequency.setTargetAtTime(1800 - 900 * load, now, SMOOTH_S);
    }
    const gain = runs ? MOTOR_GAIN * (0.8 + 0.4 * load) : 0;
    this.motorGain.gain.setTargetAtTime(gain, now, SMOOTH_S);
    for (let i = 0; i < clicks; ++i) this.click(now + 0.03 * i, tightness);
    if (knock !== undefined) this.knock(now, knock);
    if (shot) this.beep(now, SHOT_S);
    if (beeps && now >= this.nextBeepS) {
      this.beep(now, BEEP_S);
      this.nextBeepS = now + BEEP_EVERY_S;
    }
  }

  silence(): void {
    this.motorGain.gain.setTargetAtTime(0, this.context.currentTime, SMOOTH_S);
  }

  private beep(atS: number, lengthS: number): void {
    const source = this.context.createOscillator();
    const gain = this.context.createGain();
    source.frequency.value = BEEP_HZ;
    gain.gain.setValueAtTime(0, atS);
    gain.gain.linearRampToValueAtTime(BEEP_GAIN, atS + 0.008);
    gain.gain.setValueAtTime(BEEP_GAIN, atS + lengthS - 0.02);
    gain.gain.linearRampToValueAtTime(0, atS + lengthS);
    source.connect(gain).connect(this.context.destination);
    source.start(atS);
    source.stop(atS + lengthS);
  }

  /** Dull, as of metal on cartilage; harm is higher and louder. */
  private knock(atS: number, harm: number): void {
    const source = this.context.createOscillator();
    const gain = this.context.createGain();
    source.type = "triangle";
    source.frequency.value = KNOCK_HZ * (1 + harm);
    gain.gain.setValueAtTime(KNOCK_GAIN * (1 + 0.6 * harm), atS);
    gain.gain.exponentialRampToValueAtTime(0.001, atS + KNOCK_S);
    source.connect(gain).connect(this.context.destination);
    source.start(atS);
    source.stop(atS + KNOCK_S);
  }

  /** The tighter, the louder and the lower. */
  private click(atS: number, tightness: number): void {
    const source = this.context.createBufferSource();
    source.buffer = this.noise;
    const gain = this.context.createGain();
    source.playbackRate.value = 1.3 - 0.6 * tightness;
    gain.gain.value = CLICK_GAIN * (0.6 + 0.8 * tightness);
    source.connect(gain).connect(this.context.destination);
    source.start(atS);
  }
}
