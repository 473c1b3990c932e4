// A CDT as colours: where in the box a stored position lies, x red, y green, z blue; empty texels are clear.
export function cdtPicture(canvas, codes, { min, max }, format) {
  const { width, height } = canvas;
  const image = new ImageData(width, height);
  const shade = (code, axis) => (format === "rgba8" ? code : (255 * (code - min[axis])) / (max[axis] - min[axis]));
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const from = 4 * (y * width + x);
      const to = 4 * ((height - 1 - y) * width + x);
      if (codes[from + 3] === 0) continue;
      for (let axis = 0; axis < 3; ++axis) image.data[to + axis] = shade(codes[from + axis], axis);
      image.data[to + 3] = 255;
    }
  canvas.getContext("2d").putImageData(image, 0, 0);
}
