// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a run file: a plan or one sentence that says where. A plan that is found must be
// written as a run file that reads back as the same plan, and cost a known amount.
#include "base/memory.h"
#include "config/config.h"
#include "protocol/replica.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t size);

static void demand_sentence(void) {
    const char *sentence = status_sentence();
    ASSERT(strstr(sentence, ": error: ") && !strchr(sentence, '\n'));
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
        demand_sentence();
        return 0;
    }
    demand_written_plan_reads_back(plan);
    ASSERT(plan_memory(plan) > 0);
    ASSERT(plan_seconds(plan) >= 0);
    ASSERT(plan_frames(plan) >= 0);
    memory_free(plan);
    return 0;
}
