// SPDX-License-Identifier: GPL-3.0-or-later
// Reads YAML as far as run files need it, strictly: anything that could be read in two ways, or
// that a run file has no use for, is refused with the place where it stands.
#include "config/tree.h"

#include "base/memory.h"
#include "base/text.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <yaml.h>

// What bounds memory and time whatever the file holds; a run file needs a hundredth of it.
enum { SIZE_MOST = 1 << 20, DEPTH_MOST = 16, NODES_MOST = 10000 };

typedef struct TreeReader {
    const char *name;
    bool setting; // the value of a --set: it has no lines
    yaml_parser_t parser;
    size_t nodes;
} TreeReader;

// At most size - 1 bytes of `text`, control characters replaced, "..." where it was cut.
static const char *quote(char *out, size_t size, const char *text) {
    static const char more[] = "...";
    size_t length = strlen(text);
    const bool cut = length >= size;
    if (cut) length = size - sizeof more;
    // Not through the middle of a character of several bytes.
    while (cut && length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) length--;
    for (size_t i = 0; i < length; i++) out[i] = iscntrl((unsigned char)text[i]) ? '?' : text[i];
    snprintf(out + length, size - length, "%s", cut ? more : "");
    return out;
}

const char *tree_quote(char out[QUOTE_SIZE], const char *text) {
    return quote(out, QUOTE_SIZE, text);
}

__attribute__((format(printf, 4, 0))) static Status
fail_at(const char *source, int line, int column, const char *format, va_list arguments) {
    enum { SOURCE_SHOWN = 204 }; // what follows must have room in the sentence
    char sentence[640], shown[SOURCE_SHOWN];
    vsnprintf(sentence, sizeof sentence, format, arguments);
    quote(shown, sizeof shown, source);
    if (line == 0) return status_fail(BAD_DATA, "--set %s: error: %s", shown, sentence);
    return status_fail(BAD_DATA, "%s:%d:%d: error: %s", shown, line, column, sentence);
}

Status tree_fail(const Node *node, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const Status status = fail_at(node->source, node->line, node->column, format, arguments);
    va_end(arguments);
    return status;
}

__attribute__((format(printf, 3, 4))) static Status
reader_fail(const TreeReader *reader, yaml_mark_t mark, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int line = reader->setting ? 0 : (int)mark.line + 1;
    const Status status = fail_at(reader->name, line, (int)mark.column + 1, format, arguments);
    va_end(arguments);
    return status;
}

void tree_free(Node *node) {
    while (node) {
        Node *next = node->next;
        tree_free(node->first);
        memory_free(node->text);
        memory_free(node->key);
        memory_free(node);
        node = next;
    }
}

// "\0" in double quotes would cut the word short unseen.
static Status copy_scalar(const TreeReader *reader, const yaml_event_t *event, char **out) {
    const size_t length = event->data.scalar.length;
    const yaml_char_t *text = event->data.scalar.value;
    if (memchr(text, '\0', length))
        return reader_fail(reader, event->start_mark, "a NUL character in a word");
    TRY(NEW_ARRAY(*out, length + 1));
    memcpy(*out, text, length);
    return OK;
}

Node *tree_find(const Node *map, const char *key) {
    for (Node *entry = map->first; entry; entry = entry->next) {
        if (entry->key && strcmp(entry->key, key) == 0) return entry;
    }
    return NULL;
}

// The bytes of one UTF-8 character, or 0 if this is none (RFC 3629: no overlong forms, surrogates).
static size_t utf8_length(const unsigned char *byte, size_t left) {
    const size_t length = byte[0] < 0x80             ? 1
                          : (byte[0] & 0xE0) == 0xC0 ? 2
                          : (byte[0] & 0xF0) == 0xE0 ? 3
                          : (byte[0] & 0xF8) == 0xF0 ? 4
                                                     : 0;
    if (length == 0 || length > left) return 0;
    static const uint32_t first_bits[5] = {0, 0x7F, 0x1F, 0x0F, 0x07};
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
    uint32_t code = byte[0] & first_bits[length];
    for (size_t i = 1; i < length; i++) {
        if ((byte[i] & 0xC0) != 0x80) return 0;
        code = code << 6 | (byte[i] & 0x3F);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code < least[length] || code > 0x10FFFF || surrogate ? 0 : length;
}

// What libyaml would refuse without a place, or take without a word.
static Status check_characters(const TreeReader *reader, const char *text, size_t length) {
    const unsigned char *byte = (const unsigned char *)text;
    yaml_mark_t mark = {0};
    bool indenting = true;
    for (size_t i = 0; i < length;) {
        const size_t step = utf8_length(byte + i, length - i);
        const bool blank = byte[i] == '\n' || byte[i] == '\r' || byte[i] == '\t';
        if (step == 0 || byte[i] == 0x7F || (byte[i] < 0x20 && !blank))
            return reader_fail(reader, mark, "byte 0x%02x is not text; a run file is UTF-8 text",
                               byte[i]);
        if (byte[i] == '\t' && indenting)
            return reader_fail(reader, mark, "a tab; a run file is indented with spaces");
        indenting = byte[i] == '\n' || (indenting && byte[i] == ' ');
        mark.column++;
        if (byte[i] == '\n') mark = (yaml_mark_t){.line = mark.line + 1};
        i += step;
    }
    return OK;
}

static Status next_event(TreeReader *reader, yaml_event_t *event) {
    if (yaml_parser_parse(&reader->parser, event)) return OK;
    const yaml_parser_t *parser = &reader->parser;
    if (parser->error == YAML_MEMORY_ERROR)
        return status_fail(NO_MEMORY, "out of memory while reading %s", reader->name);
    const char *problem = parser->problem ? parser->problem : "it cannot be read";
    // A key without a colon is noticed only at what follows; a colon too many, at once.
    if (strstr(problem, "could not find expected ':'"))
        return reader_fail(
            reader, parser->context_mark,
            "not valid YAML: a key without ': ' behind it; a blank follows the colon");
    if (strstr(problem, "mapping values are not allowed"))
        return reader_fail(reader, parser->problem_mark,
                           "not valid YAML: no key can begin here; keys of one map are indented "
                           "alike, and a text with ': ' in it is written in quotes");
    return reader_fail(reader, parser->problem_mark, "not valid YAML: %s", problem);
}

static Status check_plain(const TreeReader *reader, const yaml_event_t *event) {
    if (event->type == YAML_ALIAS_EVENT)
        return reader_fail(reader, event->start_mark,
                           "an alias (*name); a run file has none: write the value itself");
    const yaml_char_t *anchor = NULL, *tag = NULL;
    if (event->type == YAML_SCALAR_EVENT) {
        anchor = event->data.scalar.anchor;
        tag = event->data.scalar.tag;
    } else if (event->type == YAML_SEQUENCE_START_EVENT) {
        anchor = event->data.sequence_start.anchor;
        tag = event->data.sequence_start.tag;
    } else {
        anchor = event->data.mapping_start.anchor;
        tag = event->data.mapping_start.tag;
    }
    if (anchor)
        return reader_fail(reader, event->start_mark, "an anchor (&name); a run file has none");
    if (tag) return reader_fail(reader, event->start_mark, "a tag (!name); a run file has none");
    return OK;
}

static Status new_node(TreeReader *reader, yaml_mark_t mark, Node **out) {
    if (reader->nodes++ >= NODES_MOST)
        return reader_fail(reader, mark, "more than %d values; a run file has a few dozen",
                           NODES_MOST);
    TRY(NEW(*out));
    (*out)->source = reader->name;
    (*out)->line = reader->setting ? 0 : (int)mark.line + 1;
    (*out)->column = (int)mark.column + 1;
    return OK;
}

static Status read_value(TreeReader *reader, const yaml_event_t *event, size_t depth, Node *node);

// The place of an entry is that of its key.
static Status read_entry(TreeReader *reader, const yaml_event_t *event, size_t depth, Node *map,
                         Node *entry) {
    if (map->kind == NODE_LIST) return read_value(reader, event, depth, entry);
    TRY(check_plain(reader, event));
    if (event->type != YAML_SCALAR_EVENT)
        return reader_fail(reader, event->start_mark, "a key must be a word, not a list or a map");
    const char *key = (const char *)event->data.scalar.value;
    const Node *twin = tree_find(map, key);
    if (twin && twin != entry) {
        char shown[QUOTE_SIZE];
        return reader_fail(reader, event->start_mark,
                           "the key '%s' is there twice, first in line %d", tree_quote(shown, key),
                           twin->line);
    }
    TRY(copy_scalar(reader, event, &entry->key));
    yaml_event_t value;
    TRY(next_event(reader, &value));
    const Status status = read_value(reader, &value, depth, entry);
    yaml_event_delete(&value);
    return status;
}

static Status read_entries(TreeReader *reader, size_t depth, Node *parent) {
    const yaml_event_type_t end =
        parent->kind == NODE_MAP ? YAML_MAPPING_END_EVENT : YAML_SEQUENCE_END_EVENT;
    for (Node **slot = &parent->first;; slot = &(*slot)->next) {
        yaml_event_t event;
        TRY(next_event(reader, &event));
        const bool more = event.type != end;
        Status status = more ? new_node(reader, event.start_mark, slot) : OK;
        if (more && status == OK) status = read_entry(reader, &event, depth, parent, *slot);
        yaml_event_delete(&event);
        if (!more || status != OK) return status;
        parent->count++;
    }
}

// `node` has its place; this gives it its kind and contents. The caller deletes the event.
static Status read_value(TreeReader *reader, const yaml_event_t *event, size_t depth, Node *node) {
    TRY(check_plain(reader, event));
    if (event->type == YAML_SCALAR_EVENT) {
        node->kind = NODE_WORD;
        node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
        return copy_scalar(reader, event, &node->text);
    }
    if (depth >= DEPTH_MOST)
        return reader_fail(reader, event->start_mark,
                           "nested deeper than %d levels; a run file needs 6", DEPTH_MOST);
    node->kind = event->type == YAML_MAPPING_START_EVENT ? NODE_MAP : NODE_LIST;
    return read_entries(reader, depth + 1, node);
}

static Status expect_end(TreeReader *reader) {
    for (;;) {
        yaml_event_t event;
        TRY(next_event(reader, &event));
        const yaml_event_type_t type = event.type;
        const yaml_mark_t mark = event.start_mark;
        yaml_event_delete(&event);
        if (type == YAML_STREAM_END_EVENT) return OK;
        if (type == YAML_DOCUMENT_START_EVENT)
            return reader_fail(reader, mark,
                               "a second document begins; a run file is one document");
    }
}

static Status read_root(TreeReader *reader, Node **out) {
    for (;;) {
        yaml_event_t event;
        TRY(next_event(reader, &event));
        const bool opening =
            event.type == YAML_STREAM_START_EVENT || event.type == YAML_DOCUMENT_START_EVENT;
        Status status = OK;
        if (event.type == YAML_STREAM_END_EVENT)
            status = reader_fail(
                reader, (yaml_mark_t){0},
                "there is nothing in this file; a run file has system, dynamics, protocol");
        if (!opening && status == OK) status = new_node(reader, event.start_mark, out);
        if (!opening && status == OK) status = read_value(reader, &event, 0, *out);
        yaml_event_delete(&event);
        if (!opening) return status;
    }
}

static Status read_document(TreeReader *reader, const char *text, size_t length, Node **out) {
    TRY(check_characters(reader, text, length));
    if (!yaml_parser_initialize(&reader->parser))
        return status_fail(NO_MEMORY, "out of memory while reading %s", reader->name);
    yaml_parser_set_encoding(&reader->parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&reader->parser, (const unsigned char *)text, length);
    Status status = read_root(reader, out);
    if (status == OK) status = expect_end(reader);
    yaml_parser_delete(&reader->parser);
    return status;
}

static Status read_with(TreeReader *reader, const char *text, size_t length, Node **out) {
    *out = NULL;
    const Status status = read_document(reader, text, length, out);
    if (status == OK) return OK;
    tree_free(*out);
    *out = NULL;
    return status;
}

Status tree_read_value(Node **out, const char *name, const char *text) {
    TreeReader reader = {.name = name};
    return read_with(&reader, text, strlen(text), out);
}

static Status too_long(const char *name) {
    return status_fail(BAD_DATA, "%s: error: longer than %d bytes; a run file has a few thousand",
                       name, SIZE_MOST);
}

// Some editors begin a file with U+FEFF; it says nothing in UTF-8.
static size_t mark_length(const char *text, size_t length) {
    static const char mark[] = {'\xEF', '\xBB', '\xBF'};
    return length >= sizeof mark && memcmp(text, mark, sizeof mark) == 0 ? sizeof mark : 0;
}

Status tree_read(Node **out, const char *name, const char *text, size_t length) {
    if (length > SIZE_MOST) return too_long(name);
    const size_t mark = mark_length(text, length);
    TreeReader reader = {.name = name};
    TRY(read_with(&reader, text + mark, length - mark, out));
    if ((*out)->kind == NODE_MAP) return OK;
    const Status status =
        tree_fail(*out, "a run file is a map of sections: system, dynamics, protocol, ...");
    tree_free(*out);
    *out = NULL;
    return status;
}

static Status no_such_stage(const Node *stages, const Node *place, const char *name) {
    char shown[QUOTE_SIZE];
    Text known = {0};
    for (const Node *stage = stages->first; stage; stage = stage->next) {
        const Node *called = tree_find(stage, "stage");
        if (!called || !called->text) continue;
        text_add(&known, "%s%s", known.length ? ", " : "", tree_quote(shown, called->text));
    }
    const Status status =
        tree_fail(place, "no stage is called '%s'; there is %s", tree_quote(shown, name),
                  known.length ? text_words(&known) : "none");
    text_free(&known);
    return status;
}

// An entry of a map by its key, made if need be; of a list of stages by the stage's name.
static Status set_step(Node *parent, const Node *place, const char *key, Node **out) {
    char shown[QUOTE_SIZE];
    if (parent->kind == NODE_WORD)
        return tree_fail(place, "there is nothing below '%s'", tree_quote(shown, parent->key));
    for (Node *entry = parent->first; entry; entry = entry->next) {
        const Node *name = parent->kind == NODE_LIST ? tree_find(entry, "stage") : NULL;
        const char *called = name ? name->text : entry->key;
        if (called && strcmp(called, key) == 0) return *out = entry, OK;
    }
    if (parent->kind == NODE_LIST) return no_such_stage(parent, place, key);
    Node **slot = &parent->first;
    while (*slot) slot = &(*slot)->next;
    TRY(NEW(*slot));
    (*slot)->kind = NODE_MAP;
    (*slot)->source = place->source;
    (*slot)->line = place->line;
    (*slot)->column = place->column;
    parent->count++;
    *out = *slot;
    TRY(NEW_ARRAY((*slot)->key, strlen(key) + 1));
    memcpy((*slot)->key, key, strlen(key));
    return OK;
}

// Gives `node` the contents of `value`, which is used up.
static void replace_contents(Node *node, Node *value) {
    Node old = *node;
    *node = (Node){.kind = value->kind,
                   .quoted = value->quoted,
                   .text = value->text,
                   .key = old.key,
                   .source = value->source,
                   .line = value->line,
                   .column = value->column,
                   .count = value->count,
                   .first = value->first,
                   .next = old.next};
    tree_free(old.first);
    memory_free(old.text);
    memory_free(value);
}

static Status no_such_path(const Node *place) {
    if (place->line > 0) return tree_fail(place, "a key here is a path like system.particles");
    return status_fail(BAD_USAGE,
                       "--set %.200s: error: write KEY=VALUE, where KEY is a path like "
                       "system.particles",
                       place->source);
}

// What stands at the end of the path a.b.c, made if need be. Cuts the path.
static Status walk_path(Node *root, char *path, const Node *place, Node **out) {
    char *rest = path;
    *out = root;
    for (size_t depth = 0; rest; depth++) {
        const bool whole = (*out)->key && strcmp((*out)->key, "sweep") == 0; // keys are paths there
        const char *key = strsep(&rest, whole ? "" : ".");
        if (*key == '\0' || depth >= DEPTH_MOST) return no_such_path(place);
        TRY(set_step(*out, place, key, out));
    }
    return OK;
}

static Status set_value(Node *root, char *path, const char *assignment, const char *value) {
    const Node place = {.source = assignment};
    TreeReader reader = {.name = assignment, .setting = true};
    Node *node = NULL, *contents = NULL;
    TRY(walk_path(root, path, &place, &node));
    TRY(read_with(&reader, value, strlen(value), &contents));
    replace_contents(node, contents);
    return OK;
}

static Status copy_text(char **out, const char *text, size_t length) {
    TRY(NEW_ARRAY(*out, length + 1));
    memcpy(*out, text, length);
    return OK;
}

Status tree_set(Node *root, const char *assignment) {
    const char *equals = strchr(assignment, '=');
    if (!equals || equals == assignment || equals[1] == '\0' || strlen(assignment) > SIZE_MOST)
        return status_fail(BAD_USAGE, "--set %.200s: error: write KEY=VALUE", assignment);
    char *path = NULL;
    TRY(copy_text(&path, assignment, (size_t)(equals - assignment)));
    const Status status = set_value(root, path, assignment, equals + 1);
    memory_free(path);
    return status;
}

static Status put_word(Node *node, const Node *from, const char *word) {
    Node *contents = NULL;
    TRY(NEW(contents));
    *contents = (Node){.source = from->source, .line = from->line, .column = from->column};
    const Status status = copy_text(&contents->text, word, strlen(word));
    if (status == OK)
        replace_contents(node, contents);
    else
        memory_free(contents);
    return status;
}

Status tree_put(Node *root, const char *path, const Node *from, const char *word) {
    char *steps = NULL;
    Node *node = NULL;
    TRY(copy_text(&steps, path, strlen(path)));
    Status status = walk_path(root, steps, from, &node);
    memory_free(steps);
    if (status == OK) status = put_word(node, from, word);
    return status;
}

static Status read_stream(FILE *file, const char *path, char **text, size_t *length) {
    struct stat about;
    if (fstat(fileno(file), &about) == 0 && S_ISDIR(about.st_mode))
        return status_fail(BAD_DATA, "%s: error: this is a folder; a run file is wanted", path);
    TRY(NEW_ARRAY(*text, SIZE_MOST + 2));
    *length = fread(*text, 1, SIZE_MOST + 1, file);
    if (ferror(file)) return status_fail_errno(IO_FAILED, "cannot read %s", path);
    return *length > SIZE_MOST ? too_long(path) : OK;
}

Status tree_read_file(const char *path, char **text, size_t *length) {
    *text = NULL;
    FILE *file = fopen(path, "rb");
    if (!file) return status_fail_errno(BAD_DATA, "cannot open %s", path);
    const Status status = read_stream(file, path, text, length);
    fclose(file);
    if (status == OK) return OK;
    memory_free(*text);
    *text = NULL;
    return status;
}
