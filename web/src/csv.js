// The whole table as text: one header row, comma, LF, each number in the fewest digits that give the same double again.

/** CSV of columns [{name, values}] of equal length; a number that is not finite is written as the command writes it. */
export function csv(columns) {
  const word = (value) =>
    Number.isFinite(value)
      ? Object.is(value, -0)
        ? "-0"
        : String(value)
      : Number.isNaN(value)
        ? "nan"
        : value > 0
          ? "inf"
          : "-inf";
  const rows = columns[0]?.values.length ?? 0;
  const lines = [columns.map((column) => column.name).join(",")];
  for (let row = 0; row < rows; row++)
    lines.push(columns.map((column) => word(column.values[row])).join(","));
  return `${lines.join("\n")}\n`;
}
