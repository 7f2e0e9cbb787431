// node read_back.mjs FILE: messages per topic and the first value of each, as JSON.
import { readRecording } from "./recording.mjs";

const plain = (key, value) => {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value)) return { length: value.length, first: [...value.slice(0, 3)] };
  if (Array.isArray(value) && value.length > 3) return { length: value.length, first: value.slice(0, 3) };
  return value;
};

const topics = {};
const { statistics, metadata, channels } = await readRecording(process.argv[2], ({ topic, value }) => {
  topics[topic] ??= { messages: 0, first: value };
  ++topics[topic].messages;
});
for (const channel of channels) topics[channel.topic].metadata = Object.fromEntries(channel.metadata);
console.log(JSON.stringify({ messages: statistics.messageCount.toString(), chunks: statistics.chunkCount, topics, metadata }, plain, 2));
