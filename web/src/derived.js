// The columns that a page of `gough report --thin` does not carry: lengths, rates and condition numbers by the C core, powers and
// deviations by what they are.
import core from "virtual:core";
import { bytesOf, canRun, Core, doublesOf, inflated } from "./core.js";
import { deviationColumns, legColumns, powerColumns } from "./thin_table.js";

export const WHY_NOT =
  "The command wrote this page with --thin, so that the page computes the leg lengths itself. " +
  "That needs WebAssembly, which this browser does not provide.";

/** Gives each study all of its columns; false: the browser cannot compute them. */
export async function complete(studies) {
  if (!core || !canRun()) return false;
  const module = await Core.load(await inflated(bytesOf(core)));
  for (const study of studies) {
    module.begin(doublesOf(bytesOf(study.at_rest)));
    legColumns(module, study, study.plan);
    legColumns(module, study, study.run);
    powerColumns(study);
    deviationColumns(study);
  }
  return true;
}
