// node check_killed.mjs FILE LEAST: a recording without an end reads, and holds at least LEAST vehicle states in order.
import { scanRecording } from "./recording.mjs";

const [file, least] = process.argv.slice(2);
let states = 0;
let inOrder = true;
await scanRecording(file, ({ topic, value }) => {
  if (topic !== "VehicleState") return;
  inOrder = inOrder && value.legs_done === states;
  ++states;
});
console.log(JSON.stringify({ file, states, inOrder }));
process.exit(inOrder && states >= Number(least) ? 0 : 1);
