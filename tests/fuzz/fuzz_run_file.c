// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a run file: a plan, or a sentence a line that says where, for each fault. A plan
// that is found must be written as a run file that reads back as the same plan, and cost a known
// amount.
#include "base/memory.h"
#include "config/config.h"
#include "protocol/replica.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size);

static void demand_sentences(void) {
    static const char MARK[] = ": error: ";
    const char *line = status_sentence();
    ASSERT(line[0] != '\0');
    while (*line) {
        const size_t length = strcspn(line, "\n");
        const char *mark = strstr(line, MARK);
        ASSERT(mark && mark + strlen(MARK) < line + length);
        line += length + (line[length] == '\n');
    }
}

static void demand_written_plan_reads_back(const Plan *plan) {
    char *text = NULL, *difference = NULL;
    Plan *again = NULL;
    ASSERT(config_write(plan, &text) == OK);
    ASSERT(config_read_text(&again, "plan.yaml", text, strlen(text), NULL) == OK);
    ASSERT(config_difference(plan, again, &difference) == OK);
    ASSERT(difference[0] == '\0');
    ASSERT(memcmp(plan, again, sizeof *plan) == 0);
    memory_free(text);
    memory_free(difference);
    memory_free(again);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size) {
    Plan *plan = NULL;
    if (config_read_text(&plan, "run.yaml", (const char *)bytes, size, NULL) != OK) {
        demand_sentences();
        return 0;
    }
    demand_written_plan_reads_back(plan);
    ASSERT(plan_memory(plan) > 0);
    ASSERT(plan_seconds(plan) >= 0);
    ASSERT(plan_frames(plan) >= 0);
    memory_free(plan);
    return 0;
}
