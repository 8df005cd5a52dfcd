// Reads a file with the reader of MCAP's makers, along its index and from front to back, checks it,
// and prints what is in it. Messages of Foxglove's schemas are compared with the package
// @foxglove/schemas, if there is one; their pictures are decoded.
//
//   node read-mcap.mjs FILE       with @mcap/core where node finds it (NODE_PATH is looked at, too)
import { createRequire } from "node:module";
import { open, readFile } from "node:fs/promises";
import { inflateSync } from "node:zlib";

const require = createRequire(import.meta.url);
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");

function optional(name) {
  try {
    return require(name);
  } catch {
    return undefined;
  }
}

const foxglove = optional("@foxglove/schemas/jsonschema");

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

// Where a value is not what a JSON schema says; nothing if it is. Knows what Foxglove's schemas use.
function fault(schema, value, path) {
  if (schema.oneOf)
    return schema.oneOf.some((x) => !fault(x, value, path)) ? undefined : `${path} is no choice`;
  if ("const" in schema) return value === schema.const ? undefined : `${path} is not ${schema.const}`;
  const types = {
    object: (x) => typeof x === "object" && x !== null && !Array.isArray(x),
    array: Array.isArray,
    string: (x) => typeof x === "string",
    boolean: (x) => typeof x === "boolean",
    number: (x) => typeof x === "number",
    integer: Number.isInteger,
  };
  if (!types[schema.type](value)) return `${path} is no ${schema.type}`;
  if (value < schema.minimum || value > schema.maximum) return `${path} is out of range`;
  if (value.length < schema.minItems || value.length > schema.maxItems)
    return `${path} has ${value.length} elements`;
  for (const name of schema.required ?? [])
    if (!(name in value)) return `${path} lacks ${name}`;
  for (const [name, inner] of Object.entries(schema.properties ?? {}))
    if (name in value) {
      const found = fault(inner, value[name], `${path}.${name}`);
      if (found) return found;
    }
  for (const [i, item] of schema.type === "array" ? value.entries() : []) {
    const found = fault(schema.items, item, `${path}[${i}]`);
    if (found) return found;
  }
  return undefined;
}

// Whether all fields of a schema are in another one, with the same types.
function missing(ours, theirs, path) {
  if (ours.type !== undefined && theirs.type !== undefined && ours.type !== theirs.type)
    return `${path} is a ${ours.type} instead of a ${theirs.type}`;
  for (const [name, inner] of Object.entries(ours.properties ?? {})) {
    if (!(name in (theirs.properties ?? {}))) return `${path}.${name} is not Foxglove's`;
    const found = missing(inner, theirs.properties[name], `${path}.${name}`);
    if (found) return found;
  }
  for (const name of theirs.required ?? [])
    if (ours.properties && !(name in ours.properties)) return `${path} lacks ${name}`;
  return ours.items ? missing(ours.items, theirs.items, `${path}[]`) : undefined;
}

function checkPicture({ data, format }) {
  const bytes = Buffer.from(data, "base64");
  if (format === "jpeg") {
    if (bytes.readUInt16BE(0) !== 0xffd8) fail("a JPEG does not begin like one");
    return;
  }
  if (format !== "png" || bytes.toString("latin1", 1, 4) !== "PNG") fail(`a picture is no ${format}`);
  const pieces = [];
  let width, height, depth, kind;
  for (let at = 8; at < bytes.length; ) {
    const length = bytes.readUInt32BE(at);
    const name = bytes.toString("latin1", at + 4, at + 8);
    const content = bytes.subarray(at + 8, at + 8 + length);
    if (name === "IHDR")
      [width, height, depth, kind] = [content.readUInt32BE(0), content.readUInt32BE(4), content[8], content[9]];
    if (name === "IDAT") pieces.push(content);
    at += 12 + length;
  }
  const channels = { 0: 1, 2: 3, 6: 4 }[kind];
  const pixels = inflateSync(Buffer.concat(pieces));
  if (pixels.length !== (1 + (width * channels * depth) / 8) * height) fail("a picture is not whole");
}

const file = process.argv[2];
const handle = await open(file);
const reader = await McapIndexedReader.Initialize({ readable: new FileReadable(handle) });
const text = new TextDecoder();
let messages = 0;
let last = 0n;
const counts = new Map();

function checkFoxglove(schema, value, topic) {
  const name = schema.name.slice("foxglove.".length);
  if (foxglove) {
    const theirs = foxglove[name];
    if (!theirs) fail(`Foxglove has no schema ${name}`);
    const found = fault(theirs, value, topic) ?? missing(JSON.parse(text.decode(schema.data)), theirs, name);
    if (found) fail(found);
  }
  const wrong = fault(JSON.parse(text.decode(schema.data)), value, topic);
  if (wrong) fail(wrong);
  if (name === "CompressedImage") checkPicture(value);
}

function checkOwn(schema, value, topic) {
  if (topic !== `/${value.subarchitecture ?? value.component}/${value.type}`)
    fail("a message is on the wrong topic");
  const properties = JSON.parse(text.decode(schema.data)).properties.value.properties;
  for (const name of Object.keys(value.value ?? {}))
    if (!(name in properties)) fail(`the schema lacks ${name}`);
}

for await (const message of reader.readMessages()) {
  const channel = reader.channelsById.get(message.channelId);
  const schema = reader.schemasById.get(channel.schemaId);
  const value = JSON.parse(text.decode(message.data));
  if (schema.encoding !== "jsonschema" || channel.messageEncoding !== "json")
    fail("the encoding is wrong");
  (schema.name.startsWith("foxglove.") ? checkFoxglove : checkOwn)(schema, value, channel.topic);
  const count = `${schema.name} on ${channel.topic}`;
  counts.set(count, (counts.get(count) ?? 0) + 1);
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
for (const [name, count] of [...counts].sort()) console.log(`${count} of ${name}`);
if (!foxglove) console.log("not compared with Foxglove's schemas: there is no @foxglove/schemas");
console.log(`${messages} messages, ${reader.channelsById.size} topics, ${reader.chunkIndexes.length} chunks`);
