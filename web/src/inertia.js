// The ellipsoid of equal mass and inertia: what the load looks like when only its mass, centre and inertia are known.

/** Eigenvalues and eigenvectors (columns of v, by rows) of a symmetric 3×3 matrix, by Jacobi's rotations. */
export function symmetricEigen(matrix) {
  const a = matrix.map((row) => [...row]);
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < 30; sweep++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ]) {
      if (Math.abs(a[p][q]) < 1e-300) continue;
      const ratio = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const tangent = (ratio >= 0 ? 1 : -1) / (Math.abs(ratio) + Math.hypot(ratio, 1));
      const cosine = 1 / Math.hypot(tangent, 1);
      const sine = tangent * cosine;
      for (let k = 0; k < 3; k++)
        [a[k][p], a[k][q]] = [cosine * a[k][p] - sine * a[k][q], sine * a[k][p] + cosine * a[k][q]];
      for (let k = 0; k < 3; k++)
        [a[p][k], a[q][k]] = [cosine * a[p][k] - sine * a[q][k], sine * a[p][k] + cosine * a[q][k]];
      for (let k = 0; k < 3; k++)
        [v[k][p], v[k][q]] = [cosine * v[k][p] - sine * v[k][q], sine * v[k][p] + cosine * v[k][q]];
    }
  }
  return { values: [a[0][0], a[1][1], a[2][2]], vectors: v };
}

/** Semi-axes and directions of the homogeneous ellipsoid with this mass and moments of inertia: ∫x² dm = m a²/5 and
 *  J_x = ∫y² dm + ∫z² dm give a² = 5 (J_y + J_z − J_x)/(2 m). A flat body keeps a little thickness to be seen. */
export function equalEllipsoid(mass, inertia) {
  const { values, vectors } = symmetricEigen(inertia);
  const [jx, jy, jz] = values;
  const squares = [jy + jz - jx, jz + jx - jy, jx + jy - jz].map(
    (sum) => (5 * Math.max(sum, 0)) / (2 * mass),
  );
  const largest = Math.sqrt(Math.max(...squares));
  return { axes: squares.map((square) => Math.max(Math.sqrt(square), 0.03 * largest)), vectors };
}
