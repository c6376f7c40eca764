// node read.cjs FILE.mcap: opens the file by its index with @mcap/core, decodes every message with the schema that stands
// in the file, walks over the file a second time as a stream with all CRCs checked, and prints what it found as JSON.
const fs = require("node:fs/promises");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const fzstd = require("fzstd");
const protobuf = require("protobufjs");
const descriptor = require("protobufjs/ext/descriptor");

const decompressHandlers = {
  zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))),
};

function decoderOf(schema) {
  const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(schema.data));
  return root.lookupType(schema.name);
}

async function main() {
  const handle = await fs.open(process.argv[2], "r");
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      const { bytesRead } = await handle.read(buffer, 0, buffer.length, Number(offset));
      if (bytesRead !== buffer.length) throw new Error(`read ${bytesRead} of ${length} bytes at ${offset}`);
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const decoders = new Map();
  for (const [id, schema] of reader.schemasById) decoders.set(id, decoderOf(schema));

  const topics = {};
  let lastTime = 0n;
  let ordered = true;
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const value = decoders.get(channel.schemaId).decode(message.data);
    const topic = (topics[channel.topic] ??= { schema: reader.schemasById.get(channel.schemaId).name, messages: 0, fields: [] });
    topic.messages++;
    topic.fields = Object.keys(value.toJSON());
    ordered &&= message.logTime >= lastTime;
    lastTime = message.logTime;
  }
  const attachments = {};
  for await (const attachment of reader.readAttachments()) attachments[attachment.name] = attachment.data.length;

  const stream = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  stream.append(new Uint8Array(await fs.readFile(process.argv[2])));
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") streamed++;

  console.log(JSON.stringify({
    indexed: Number(reader.statistics.messageCount), streamed, ended: stream.done(), ordered, topics, attachments,
    library: reader.header.library, chunks: reader.chunkIndexes.length,
  }));
}

main().catch((error) => { console.error(error); process.exit(1); });
