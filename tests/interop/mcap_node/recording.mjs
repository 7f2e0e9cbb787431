// Reads a recording with @mcap/core and @foxglove/omgidl-*; none of the project's own code is used.
import { open } from "node:fs/promises";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { FileHandleReadable } from "@mcap/nodejs";
import { loadDecompressHandlers } from "@mcap/support";
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";

const text = new TextDecoder();

function decoder(channel, schema) {
  if (channel.messageEncoding === "json") return (data) => JSON.parse(text.decode(data));
  if (channel.messageEncoding !== "cdr" || schema?.encoding !== "omgidl") {
    throw new Error(`${channel.topic}: ${channel.messageEncoding} with ${schema?.encoding} cannot be decoded`);
  }
  const reader = new MessageReader(schema.name, parseIDL(text.decode(schema.data)));
  return (data) => reader.readMessage(data);
}

/** Calls visit({topic, sequence, logTime, publishTime, value, channel}) for each message, in log order. */
export async function readRecording(path, visit) {
  const decompressHandlers = await loadDecompressHandlers();
  const file = await open(path, "r");
  try {
    const readable = new FileHandleReadable(file);
    const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
    const decoders = new Map();
    for await (const message of reader.readMessages({ validateCrcs: true })) {
      const channel = reader.channelsById.get(message.channelId);
      if (!decoders.has(channel.id)) decoders.set(channel.id, decoder(channel, reader.schemasById.get(channel.schemaId)));
      const value = decoders.get(channel.id)(message.data);
      visit({ topic: channel.topic, sequence: message.sequence, logTime: message.logTime, publishTime: message.publishTime, value, channel });
    }
    const metadata = {};
    for await (const record of reader.readMetadata()) metadata[record.name] = Object.fromEntries(record.metadata);
    return { statistics: reader.statistics, metadata, channels: [...reader.channelsById.values()] };
  } finally {
    await file.close();
  }
}

/** As readRecording, by one pass from the start: for files whose writer died. Gives the number of messages. */
export async function scanRecording(path, visit) {
  const decompressHandlers = await loadDecompressHandlers();
  const file = await open(path, "r");
  const channels = new Map();
  const schemas = new Map();
  let count = 0;
  try {
    const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
    for await (const bytes of file.createReadStream({ autoClose: false })) {
      reader.append(bytes);
      for (let record; (record = reader.nextRecord()); ) {
        if (record.type === "Schema") schemas.set(record.id, record);
        if (record.type === "Channel") channels.set(record.id, { record, decode: decoder(record, schemas.get(record.schemaId)) });
        if (record.type !== "Message") continue;
        ++count;
        const channel = channels.get(record.channelId);
        visit({ topic: channel.record.topic, sequence: record.sequence, logTime: record.logTime, publishTime: record.publishTime, value: channel.decode(record.data), channel: channel.record });
      }
    }
  } finally {
    await file.close();
  }
  return count;
}
