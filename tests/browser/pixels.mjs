// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a screenshot shows, pixel by pixel: the page's own browser decodes it.

/** @return  {width, height, data}: of each pixel, row by row, red, green, blue, alpha, 0 to 255 */
export async function pixelsOf(page, png) {
  const { width, height, text } = await page.evaluate(async (picture) => {
    const bitmap = await createImageBitmap(await (await fetch(picture)).blob());
    const drawing = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    drawing.drawImage(bitmap, 0, 0);
    const { data } = drawing.getImageData(0, 0, bitmap.width, bitmap.height);
    let bytes = "";
    for (let from = 0; from < data.length; from += 32_768)
      bytes += String.fromCharCode(...data.subarray(from, from + 32_768));
    return { width: bitmap.width, height: bitmap.height, text: btoa(bytes) };
  }, `data:image/png;base64,${png.toString("base64")}`);
  return { width, height, data: Buffer.from(text, "base64") };
}
