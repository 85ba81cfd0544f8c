#include "progress.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define BAR_WIDTH 30
#define DELAY_SECONDS 1.0    /* work that is done sooner needs no bar */
#define INTERVAL_SECONDS 0.1 /* below this terminals flicker, above it the bar seems stuck */
#define PATIENCE_SECONDS 2   /* for work to notice a signal and clean up */

/* There is one terminal and one process to signal: the only state that is not in a struct. */
static volatile sig_atomic_t signal_received;
static bool bar_is_shown;

static double seconds_since(const struct timespec *then, const struct timespec *now)
{
    return (double)(now->tv_sec - then->tv_sec) + (double)(now->tv_nsec - then->tv_nsec) * 1e-9;
}

void cli_progress_init(cli_progress *progress, const cli_common *common)
{
    memset(progress, 0, sizeof *progress);
    progress->mode = (cli_progress_mode)common->progress;
    if (progress->mode == CLI_PROGRESS_AUTO && (common->quiet || !isatty(STDERR_FILENO))) {
        progress->mode = CLI_PROGRESS_NEVER;
    }
    clock_gettime(CLOCK_MONOTONIC, &progress->begin);
    progress->shown = progress->begin;
}

static bool is_due(cli_progress *progress)
{
    struct timespec now;
    if (progress->mode == CLI_PROGRESS_NEVER) {
        return false;
    }
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (progress->mode == CLI_PROGRESS_AUTO && seconds_since(&progress->begin, &now) < DELAY_SECONDS) {
        return false;
    }
    if (bar_is_shown && seconds_since(&progress->shown, &now) < INTERVAL_SECONDS) {
        return false;
    }
    progress->shown = now;
    return true;
}

bool cli_progress_step(void *user, const char *task, double fraction)
{
    if (is_due(user)) {
        char bar[BAR_WIDTH + 1];
        double share = fraction >= 0 && fraction <= 1 ? fraction : 0;
        int filled = (int)(share * BAR_WIDTH);
        memset(bar, '#', (size_t)filled);
        memset(bar + filled, '.', (size_t)(BAR_WIDTH - filled));
        bar[BAR_WIDTH] = '\0';
        fprintf(stderr, "\r\033[K[%s] %3d%% %s", bar, (int)(share * 100), task);
        fflush(stderr);
        bar_is_shown = true;
    }
    return signal_received == 0;
}

void cli_progress_clear(void)
{
    if (bar_is_shown) {
        fputs("\r\033[K", stderr);
        bar_is_shown = false;
    }
}

/* Work that waits, for standard input perhaps, asks no one whether to go on. */
static void give_up(int number)
{
    (void)number;
    _exit(128 + signal_received);
}

static void note_signal(int number)
{
    signal_received = number;
    alarm(PATIENCE_SECONDS);
}

void cli_signals_init(void)
{
    static const int stopping[] = {SIGINT, SIGTERM, SIGHUP};
    struct sigaction action, previous;
    memset(&action, 0, sizeof action);
    action.sa_handler = note_signal;
    action.sa_flags = (int)(SA_RESETHAND | SA_RESTART);
    for (size_t i = 0; i < sizeof stopping / sizeof stopping[0]; i++) {
        /* nohup and shells that start jobs in the background ignore some of these: so it stays. */
        if (sigaction(stopping[i], NULL, &previous) == 0 && previous.sa_handler != SIG_IGN) {
            sigaction(stopping[i], &action, NULL);
        }
    }
    action.sa_handler = give_up;
    sigaction(SIGALRM, &action, NULL);
    action.sa_handler = SIG_IGN;
    action.sa_flags = 0;
    sigaction(SIGPIPE, &action, NULL);
    sigaction(SIGXFSZ, &action, NULL); /* a file that may not grow is an error of writing */
}

int cli_signal_received(void)
{
    return signal_received;
}
