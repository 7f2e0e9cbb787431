#pragma once

#include "tools/record/mcap/bytes.hpp"

/// Whole records, opcode and length included, appended to a buffer.
namespace swallowtail::mcap {

void put_record(ByteSink& out, const Schema& schema);
void put_record(ByteSink& out, const Channel& channel);
void put_record(ByteSink& out, const Message& message);
void put_record(ByteSink& out, const Metadata& metadata);
void put_record(ByteSink& out, const MetadataIndex& index);
void put_record(ByteSink& out, const ChunkIndex& index);
void put_record(ByteSink& out, const Statistics& statistics);

}  // namespace swallowtail::mcap
