// SPDX-License-Identifier: GPL-3.0-or-later
// Two slots per replica, each a header and a payload with a CRC-32C of their own. A slot is
// replaced whole while the other, the last acknowledged one, lies untouched.
#include "store/checkpoint.h"

#include "base/crc32c.h"
#include "store/inside.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SLOTS = 2, SLOT_NAME_SIZE = 40, VERSION = 1 };

static const char MAGIC[8] = {'P', 'E', 'R', 'R', 'I', 'N', 'C', 'K'};
static const uint32_t ENDIAN_TAG = 0x01020304;

typedef struct Header {
    char magic[8];
    uint32_t version;
    uint32_t endian_tag;
    uint64_t plan; // hash of its text
    uint64_t replica;
    uint64_t sequence; // rises by one with each checkpoint of the replica
    uint64_t length;   // of the payload behind the header
    uint32_t payload_crc;
    uint32_t header_crc; // of the bytes before it
} Header;

_Static_assert(sizeof(Header) == 56, "the header lies in the file as it does in memory");

static uint32_t header_crc(const Header *header) {
    return crc32c(0, header, offsetof(Header, header_crc));
}

static void slot_name(char name[SLOT_NAME_SIZE], size_t replica, int slot) {
    snprintf(name, SLOT_NAME_SIZE, "replica-%04zu.%c", replica, "ab"[slot]);
}

static Status damaged(const char *path, const char *what) {
    return status_fail(BAD_DATA, "'%s' is no usable checkpoint: %s", path, what);
}

static Status check_header(const Header *header, size_t file_size, const char *path) {
    if (memcmp(header->magic, MAGIC, sizeof MAGIC) != 0) {
        return damaged(path, "it is not a checkpoint of perrin");
    }
    if (header->header_crc != header_crc(header)) return damaged(path, "its header is damaged");
    if (header->endian_tag != ENDIAN_TAG) {
        return damaged(path, "it comes from a machine with another order of bytes");
    }
    if (header->version != VERSION) return damaged(path, "it has another version of the format");
    if (header->length > file_size - sizeof *header) return damaged(path, "it was cut off");
    if (header->length < file_size - sizeof *header) {
        return damaged(path, "there is more in it than belongs to it");
    }
    return OK;
}

static Status take_header(Header *header, const void *file, size_t file_size, const char *path) {
    if (file_size < sizeof *header) return damaged(path, "it was cut off");
    memcpy(header, file, sizeof *header);
    return check_header(header, file_size, path);
}

static Status check_whole(Header *header, const void *file, size_t file_size, const char *path) {
    TRY(take_header(header, file, file_size, path));
    const unsigned char *payload = (const unsigned char *)file + sizeof *header;
    if (crc32c(0, payload, header->length) == header->payload_crc) return OK;
    return damaged(path, "its contents are damaged");
}

Status checkpoint_check(const void *file, size_t file_size, const char *path, uint64_t *sequence,
                        const void **bytes, size_t *size) {
    Header header;
    TRY(check_whole(&header, file, file_size, path));
    *sequence = header.sequence;
    *bytes = (const unsigned char *)file + sizeof header;
    *size = header.length;
    return OK;
}

// The header of a slot as far as it can be used; false if there is none.
static bool peek(const Folder *folder, const char *name, Header *header) {
    int slot;
    size_t size;
    if (disk_open(folder, name, O_RDONLY, &slot) != OK || slot < 0) return false;
    const bool usable = disk_size(slot, &size, name) == OK && size >= sizeof *header &&
                        disk_read(slot, header, sizeof *header, 0, name) == OK &&
                        check_header(header, size, name) == OK;
    close(slot);
    return usable;
}

// The slot to write next, which is the one that does not hold the newest, and its number.
static int next_slot(const Folder *folder, size_t replica, uint64_t *sequence) {
    int slot = 0;
    *sequence = 1;
    for (int i = 0; i < SLOTS; i++) {
        char name[SLOT_NAME_SIZE];
        Header header;
        slot_name(name, replica, i);
        if (!peek(folder, name, &header) || header.sequence < *sequence) continue;
        *sequence = header.sequence + 1;
        slot = 1 - i;
    }
    return slot;
}

static Status write_slot(const Folder *folder, const char *name, const Header *header,
                         const void *bytes) {
    int file;
    TRY(disk_create(folder, name, &file));
    char *path = disk_path(folder, name);
    Status status = path ? disk_write(file, header, sizeof *header, 0, path) : NO_MEMORY;
    if (status == OK) status = disk_write(file, bytes, header->length, sizeof *header, path);
    free(path);
    if (status == OK) return disk_publish(folder, name, file);
    disk_discard(folder, name, file);
    return status;
}

Status checkpoint_write(Store *store, size_t replica, const void *bytes, size_t size) {
    Folder folder;
    TRY(disk_folder_open(&folder, &store->folder, "checkpoint", true));
    Header header = {
        .version = VERSION,
        .endian_tag = ENDIAN_TAG,
        .plan = store->plan,
        .replica = replica,
        .length = size,
        .payload_crc = crc32c(0, bytes, size),
    };
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    char name[SLOT_NAME_SIZE];
    slot_name(name, replica, next_slot(&folder, replica, &header.sequence));
    header.header_crc = header_crc(&header);
    const Status status = write_slot(&folder, name, &header, bytes);
    disk_folder_close(&folder);
    return status;
}

typedef struct Slot {
    Header header;
    void *file;
    Status status;
    char complaint[512];
} Slot;

static Status load_checked(Slot *slot, const Store *store, size_t replica, const Folder *folder,
                           const char *name) {
    size_t size;
    TRY(disk_load(folder, name, &slot->file, &size));
    if (!slot->file) return OK;
    char *path = disk_path(folder, name);
    Status status = path ? check_whole(&slot->header, slot->file, size, path) : NO_MEMORY;
    if (status == OK && slot->header.plan != store->plan) {
        status = damaged(path, "it belongs to another plan");
    }
    if (status == OK && slot->header.replica != replica) {
        status = damaged(path, "it belongs to another replica");
    }
    free(path);
    return status;
}

static void load_slot(Slot *slot, const Store *store, size_t replica, const Folder *folder,
                      const char *name) {
    slot->status = load_checked(slot, store, replica, folder, name);
    if (slot->status == OK) return;
    snprintf(slot->complaint, sizeof slot->complaint, "%s", status_sentence());
    free(slot->file);
    slot->file = NULL;
}

// Which slot counts; NULL if neither can be used.
static Slot *newest(Slot slots[SLOTS]) {
    Slot *best = NULL;
    for (int i = 0; i < SLOTS; i++) {
        if (!slots[i].file) continue;
        if (!best || slots[i].header.sequence > best->header.sequence) best = &slots[i];
    }
    return best;
}

static Status choose_slot(Store *store, Slot slots[SLOTS], void **bytes, size_t *size) {
    Slot *best = newest(slots);
    for (int i = 0; i < SLOTS; i++) {
        if (slots[i].status == OK) continue;
        if (!best) return status_fail(slots[i].status, "%s", slots[i].complaint);
        TRY(store_log(store, "warning: %s; going on from the checkpoint before it",
                      slots[i].complaint));
    }
    if (!best) return OK;
    *size = best->header.length;
    *bytes = best->file;
    memmove(best->file, (char *)best->file + sizeof best->header, *size);
    best->file = NULL; // now the caller's
    return OK;
}

Status checkpoint_read(Store *store, size_t replica, void **bytes, size_t *size) {
    *bytes = NULL;
    *size = 0;
    if (!disk_has(&store->folder, "checkpoint")) return OK;
    Folder folder;
    TRY(disk_folder_open(&folder, &store->folder, "checkpoint", false));
    Slot slots[SLOTS] = {{.file = NULL}};
    for (int i = 0; i < SLOTS; i++) {
        char name[SLOT_NAME_SIZE];
        slot_name(name, replica, i);
        load_slot(&slots[i], store, replica, &folder, name);
    }
    const Status status = choose_slot(store, slots, bytes, size);
    for (int i = 0; i < SLOTS; i++) free(slots[i].file);
    disk_folder_close(&folder);
    return status;
}
