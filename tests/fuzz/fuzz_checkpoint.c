// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a checkpoint, a state, a replica with its observers, and results from the process
// that reads results.h5: something valid, or one sentence. The first byte chooses; where checksums
// would keep the fuzzer out they are put right first, as somebody with a hex editor would.
#include "base/crc32c.h"
#include "base/memory.h"
#include "config/config.h"
#include "protocol/replica.h"
#include "state/state.h"
#include "store/checkpoint.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size);

// docs/file-format.md: where the checksums of a checkpoint lie.
enum { PAYLOAD_CRC = 48, HEADER_CRC = 52, HEADER = 56, FILE_MOST = 4096 };

static const System *small_system(void) {
    static const System system = {
        .dimension = 2,
        .particles = 5,
        .packing_fraction = 0.3,
        .species_count = 1,
        .species = {{.name = "disc", .diameter = 1, .mass = 1, .fraction = 1}},
    };
    return &system;
}

static void demand_sentence(void) {
    const char *sentence = status_sentence();
    ASSERT(sentence[0] != '\0' && !strchr(sentence, '\n'));
}

static void load_state(const void *bytes, size_t size) {
    State *state = NULL;
    ASSERT(state_create(&state, small_system()) == OK);
    Archive archive = archive_reader(bytes, size);
    state_archive(state, &archive);
    if (archive_status(&archive, true) == OK)
        ASSERT(state_validate(state) == OK);
    else
        demand_sentence();
    state_free(state);
}

// Read once: all observables of a small run.
static const Plan *small_plan(void) {
    static Plan *plan;
    static const char text[] =
        "system:\n"
        "  {dimension: 2, particles: 5, packing_fraction: 0.3,\n"
        "   species: {a: {shape: disc, fraction: 0.6}, b: {shape: disc, fraction: 0.4}}}\n"
        "dynamics: {method: event-driven, thermostat_interval: 0.1}\n"
        "protocol:\n"
        "  - {stage: one, time: 0.1, observe: [mean_squared_displacement, pressure]}\n"
        "  - {stage: two, time: 0.1,\n"
        "     observe: [pair_distribution, structure_factor, snapshot, velocity_distribution]}\n"
        "ensemble: {replicas: 1, seed: 1}\n";
    if (!plan) ASSERT(config_read_text(&plan, "fuzz", text, sizeof text - 1, NULL) == OK);
    return plan;
}

// A replica that was accepted is the one that its bytes say.
static void load_replica(const void *bytes, size_t size) {
    Replica *replica = NULL;
    Archive archive = archive_reader(bytes, size);
    if (replica_load(&replica, small_plan(), 0, &archive) != OK) {
        demand_sentence();
        return;
    }
    Archive again = archive_writer();
    replica_save(replica, &again);
    ASSERT(archive_status(&again, true) == OK);
    ASSERT(again.size == size && memcmp(again.bytes, bytes, size) == 0);
    archive_free(&again);
    replica_free(replica);
}

static void load_results(const void *bytes, size_t size) {
    Results *results = NULL;
    ASSERT(results_create(&results, 0) == OK);
    Archive archive = archive_reader(bytes, size);
    results_archive(results, &archive);
    if (archive_status(&archive, true) != OK) demand_sentence();
    results_free(results);
}

static void load_checkpoint(const void *file, size_t size) {
    uint64_t sequence;
    const void *payload;
    size_t length;
    if (checkpoint_check(file, size, "replica-0000.a", &sequence, &payload, &length) != OK) {
        demand_sentence();
        ASSERT(strstr(status_sentence(), "replica-0000.a"));
        return;
    }
    ASSERT((const char *)payload + length == (const char *)file + size);
    load_state(payload, length);
}

static void load_with_checksums(const unsigned char *bytes, size_t size) {
    unsigned char file[FILE_MOST];
    if (size < HEADER || size > sizeof file) return;
    memcpy(file, bytes, size);
    const uint32_t payload = crc32c(0, file + HEADER, size - HEADER);
    memcpy(file + PAYLOAD_CRC, &payload, sizeof payload);
    const uint32_t header = crc32c(0, file, HEADER_CRC);
    memcpy(file + HEADER_CRC, &header, sizeof header);
    load_checkpoint(file, size);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size) {
    if (size == 0) return 0;
    const unsigned char choice = *bytes++;
    size--;
    if (choice % 5 == 0) load_checkpoint(bytes, size);
    if (choice % 5 == 1) load_with_checksums(bytes, size);
    if (choice % 5 == 2) load_state(bytes, size);
    if (choice % 5 == 3) load_results(bytes, size);
    if (choice % 5 == 4) load_replica(bytes, size);
    return 0;
}
