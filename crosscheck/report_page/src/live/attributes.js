function attribute(gl, program, name, components, stride, offset, divisor) {
  const location = program.attribute(name);
  if (location < 0) return;
  gl.enableVertexAttribArray(location);
  gl.vertexAttribPointer(location, components, gl.FLOAT, false, stride, offset);
  gl.vertexAttribDivisor(location, divisor);
}

const WORD = 4; // bytes

// Particles, of which each is a `record`, as a pass reads them. A pass that makes several vertices of a particle draws
// each as an instance.
export function particleArray(gl, program, buffer, { words, fields }) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  for (const { shader, components, offset } of fields)
    attribute(gl, program, `a_${shader}`, components, WORD * words, WORD * offset, program.maxVertices > 1 ? 1 : 0);
  gl.bindVertexArray(null);
  return array;
}

// Obstacles as a pass reads them, and how it draws them: their vertices as points, or each triangle as an instance
// whose corners are a_Position_0 to a_Position_2.
export function meshArray(gl, program, { positions, indices }) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  const points = program.corners === 1;
  if (points) {
    gl.bufferData(gl.ARRAY_BUFFER, positions, gl.STATIC_DRAW);
    attribute(gl, program, "a_Position", 3, 12, 0, 0);
  } else {
    const corners = new Float32Array(3 * indices.length);
    indices.forEach((index, i) => corners.set(positions.subarray(3 * index, 3 * index + 3), 3 * i));
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    for (let corner = 0; corner < 3; ++corner) attribute(gl, program, `a_Position_${corner}`, 3, 36, 12 * corner, 1);
  }
  gl.bindVertexArray(null);
  const draw = () => {
    gl.bindVertexArray(array);
    if (points) gl.drawArrays(gl.POINTS, 0, positions.length / 3);
    else gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, program.maxVertices, indices.length / 3);
    gl.bindVertexArray(null);
  };
  return { draw };
}
