// Every test of the explorer.

import "./patch.mjs";
import "./compare.mjs";
import "./views.mjs";
import "./surface.mjs";
import "./speed.mjs";
import "./stage.mjs";
import { runAll } from "./harness.mjs";

await runAll();
