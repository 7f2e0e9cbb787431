// node check_values.mjs FILE STATES TILES VENDOR=BASE…: each vendor's samples are all there, with the values that
// scenario.hpp sends. Exits 1 with a list of what is wrong.
import { readRecording } from "./recording.mjs";

const [file, states, tiles, ...vendors] = process.argv.slice(2);
const problems = [];
const note = (text) => problems.length < 50 && problems.push(text);
const expect = (what, is, wanted) => is === wanted || note(`${what} is ${is}, not ${wanted}`);

const TILE_CELLS = 15000;
const seen = new Map(); // "base/topic" -> values in order
let lastLog = 0n;
let lastSequence = new Map();
const keyFields = { TerrainTile: "map_id", Obstacle: "obstacle_id", CoverageTask: "task_id", ChargerPlan: "charger_id", ChargerState: "charger_id", ParticipantStatus: "participant_id" };
const keyOf = (topic, value) => value[keyFields[topic] ?? "vehicle_id"];
const baseOf = (key) => Math.floor(key / 100) * 100;

const { statistics, metadata } = await readRecording(file, ({ topic, sequence, logTime, publishTime, value }) => {
  if (logTime < lastLog) note(`${topic}: log times go back`);
  lastLog = logTime;
  expect(`${topic}: sequence`, sequence, (lastSequence.get(topic) ?? 0) + 1);
  lastSequence.set(topic, sequence);
  const delay_ms = Number(logTime - publishTime) / 1e6;
  if (delay_ms < -1 || delay_ms > 30000) note(`${topic}: received ${delay_ms} ms after it was published`);
  const key = topic.endsWith("#lifecycle") ? [value.key].flat().at(topic.startsWith("CoveragePlan") ? 1 : 0) : keyOf(topic, value);
  const name = `${topic === "MissionClock" ? 0 : baseOf(key)}/${topic}`;
  seen.set(name, [...(seen.get(name) ?? []), value]);
});

function checkVendor(vendor, base) {
  const of = (topic) => seen.get(`${base}/${topic}`) ?? [];
  const one = (topic) => of(topic)[0] ?? {};
  const count = (topic, wanted) => expect(`${vendor}: number of ${topic}`, of(topic).length, wanted);
  count("VehicleState", Number(states));
  of("VehicleState").forEach((s, i) => {
    expect(`${vendor}: VehicleState ${i} legs_done`, s.legs_done, i);
    expect(`${vendor}: VehicleState ${i} time_s`, s.time_s, 0.002 * i);
    expect(`${vendor}: VehicleState ${i} y_m`, s.position.y_m, -i);
    expect(`${vendor}: VehicleState ${i} mode`, s.mode, 3);
  });
  count("TerrainTile", Number(tiles));
  const tileNumbers = new Set();
  for (const t of of("TerrainTile")) {
    const n = t.row * 10 + t.col;
    tileNumbers.add(n);
    expect(`${vendor}: tile ${n} cells`, t.elevation_m.length, TILE_CELLS);
    for (let c = 0; c < TILE_CELLS; c += 1) if (t.elevation_m[c] !== n + (c % 1000) * 0.25) { note(`${vendor}: tile ${n} cell ${c} is ${t.elevation_m[c]}`); break; }
  }
  expect(`${vendor}: different tiles`, tileNumbers.size, Number(tiles));
  for (const topic of ["BatteryState", "CoverageTask", "Goal", "ChargerPlan", "PathPlan", "CoveragePlan", "ChargerState", "ParticipantStatus"]) count(topic, 1);
  expect(`${vendor}: energy`, one("BatteryState").energy, 400);
  expect(`${vendor}: seed`, one("CoverageTask").seed, 18446744073709551615n);
  expect(`${vendor}: point`, one("CoverageTask").points?.[2].y_m, 50);
  const task = one("CoverageTask");
  expect(`${vendor}: ring`, task.rings?.[1].kind, 1);
  expect(`${vendor}: road`, task.roads?.[0].point_count, 3);
  expect(`${vendor}: rules`, `${task.rules?.overlap} ${task.rules?.has_sweep} ${task.rules?.headland}`, "0.25 true 2");
  expect(`${vendor}: battery`, `${task.battery?.taper_from} ${task.battery?.model.multirotor.rotors} ${task.battery?.model.wind_north_mps}`, "0.75 6 -2.5");
  expect(`${vendor}: ground`, `${task.charger?.ground.kind} ${task.charger?.ground.area_max.y_m}`, "1 8");
  expect(`${vendor}: goal`, one("Goal").position?.x_m, 780);
  expect(`${vendor}: rendezvous`, one("ChargerPlan").rendezvous?.[0].carry_to.y_m, 4);
  expect(`${vendor}: robot's way`, one("ChargerPlan").bends?.[one("ChargerPlan").rendezvous?.[0].carry_first_bend].y_m, 9);
  expect(`${vendor}: robot's speed`, one("ChargerPlan").rendezvous?.[0].carry_speed_mps, 1.25);
  expect(`${vendor}: robot's energy`, one("ChargerPlan").rendezvous?.[0].robot_energy_left, 80);
  expect(`${vendor}: robot's battery`, one("ChargerPlan").battery?.refill_s, 60);
  expect(`${vendor}: path's waypoints`, one("PathPlan").waypoints?.length, 500);
  expect(`${vendor}: last waypoint`, one("PathPlan").waypoints?.[499].position.x_m, 499);
  expect(`${vendor}: path's reason`, one("PathPlan").reason, "obstacle 9 appeared");
  expect(`${vendor}: legs`, one("CoveragePlan").legs?.length, 4096);
  expect(`${vendor}: last leg`, one("CoveragePlan").legs?.[4095].end_s, 40950);
  expect(`${vendor}: last leg's bends`, one("CoveragePlan").bends?.[one("CoveragePlan").legs?.[4095].first_bend + 1].x_m, 4095.5);
  expect(`${vendor}: charger's activity`, one("ChargerState").activity, 2);
  expect(`${vendor}: charger's energy`, one("ChargerState").energy, 240.25);
  expect(`${vendor}: rejection`, one("ParticipantStatus").rejected?.[0].count, 3n);
  const obstacles = new Set(of("Obstacle").map((o) => o.obstacle_id));
  expect(`${vendor}: obstacles`, [...obstacles].sort().join(), [base, base + 1, base + 2].join());
  expect(`${vendor}: mesh`, of("Obstacle").find((o) => o.obstacle_id === base)?.vertices.length, 4);
  const ending = of("Obstacle#lifecycle")[0] ?? {};
  expect(`${vendor}: first ending`, `${ending.kind} ${ending.key} ${ending.key_hex}`, `dispose ${base + 1} ${(base + 1).toString(16).padStart(8, "0")}`);
}

for (const vendor of vendors) checkVendor(...((text) => [text[0], Number(text[1])])(vendor.split("=")));
expect("clock samples", (seen.get("0/MissionClock") ?? []).length, vendors.length);
const own = seen.get("0/ParticipantStatus") ?? [];
expect("the recorder's own status", `${own[0]?.participant_id} ${own[0]?.name} ${own[0]?.health}`, "5 recorder 1");
expect("clock's rate", (seen.get("0/MissionClock") ?? [{}])[0].rate, 4);
for (const [topic, json] of Object.entries(metadata["swallowtail.recorder"] ?? { none: '{"dropped":"no counters in the file"}' })) {
  const { dropped, lost } = JSON.parse(json);
  expect(`${topic}: dropped`, dropped, 0);
  expect(`${topic}: lost`, lost, 0);
}
for (const problem of problems) console.error(problem);
console.log(JSON.stringify({ file, messages: Number(statistics.messageCount), problems: problems.length }));
process.exit(problems.length === 0 ? 0 : 1);
