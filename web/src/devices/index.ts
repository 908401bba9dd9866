// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the hands hold: devices of the station, chosen, tried and calibrated.
export { DevicesDialog, type DeviceHandlers } from "./devices_dialog";
export { DeviceView } from "./device_view_model";
export { heldText, isPushedWith, lostText } from "./device_model";
