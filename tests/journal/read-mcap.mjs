// Reads a file with the reader of MCAP's makers, along its index and from front to back, and prints
// what is in it.
//
//   node read-mcap.mjs FILE       with @mcap/core where node finds it (NODE_PATH is looked at, too)
import { createRequire } from "node:module";
import { open, readFile } from "node:fs/promises";

const require = createRequire(import.meta.url);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");

class FileReadable {
  constructor(handle) {
    this.handle = handle;
  }
  async size() {
    return BigInt((await this.handle.stat()).size);
  }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    if (bytesRead !== buffer.length) throw new Error("the file is too short");
    return buffer;
  }
}

function fail(why) {
  console.error(why);
  process.exit(1);
}

const file = process.argv[2];
const handle = await open(file);
const reader = await McapIndexedReader.Initialize({ readable: new FileReadable(handle) });
const text = new TextDecoder();
let messages = 0;
let last = 0n;
for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  const value = JSON.parse(text.decode(message.data));
  if (schema.encoding !== "jsonschema" || channel.messageEncoding !== "json")
    fail("the encoding is wrong");
  if (channel.topic !== `/${value.subarchitecture}/${value.type}`) fail("a message is on the wrong topic");
  const properties = JSON.parse(text.decode(schema.data)).properties.value.properties;
  for (const name of Object.keys(value.value ?? {}))
    if (!(name in properties)) fail(`the schema lacks ${name}`);
  if (message.logTime < last) fail("time goes backwards");
  last = message.logTime;
  ++messages;
}
const { statistics } = reader;
if (statistics.messageCount !== BigInt(messages)) fail("the statistics are wrong");
if (statistics.messageEndTime !== last) fail("the statistics' end is wrong");

const stream = new McapStreamReader({ validateCrcs: true });
stream.append(await readFile(file));
let streamed = 0;
for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") ++streamed;
if (!stream.done() || streamed !== messages) fail("from front to back it is another file");
console.log(`${messages} messages, ${reader.channelsById.size} topics, ${reader.chunkIndexes.length} chunks`);
