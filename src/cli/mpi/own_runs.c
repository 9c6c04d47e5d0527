/* The writer's own thread, which runs blocks like the other processes but is asked through memory. It calls nothing of MPI. */
#include "cli/mpi/own_runs.h"

static int collect(void *context, const gough_sweep_row *row) {
    own_runs *own = context;
    own->outcome[own->count++] = row->outcome;
    return 0;
}

static int look(void *context, size_t done) {
    own_runs *own = context;
    (void)done;
    pthread_mutex_lock(&own->lock);
    const bool stop = own->stop;
    pthread_mutex_unlock(&own->lock);
    return stop;
}

static void *work(void *context) {
    own_runs *own = context;
    pthread_mutex_lock(&own->lock);
    for (;;) {
        while (!own->asked && !own->leave) pthread_cond_wait(&own->moved, &own->lock);
        if (own->leave) break;
        gough_sweep_options options = own->options;
        gough_error error = {.message = ""};
        options.first = own->block.first;
        options.last = own->block.first + own->block.count - 1;
        options.progress = look;
        options.context = own;
        pthread_mutex_unlock(&own->lock);
        const gough_status status = gough_sweep_run(own->sweep, &options, collect, own, &error);
        pthread_mutex_lock(&own->lock);
        own->status = status;
        own->error = error;
        own->asked = false;
    }
    pthread_mutex_unlock(&own->lock);
    return NULL;
}

void own_runs_start(own_runs *own, const gough_sweep *sweep, const gough_sweep_options *options) {
    *own = (own_runs){.sweep = sweep, .options = *options};
    pthread_mutex_init(&own->lock, NULL);
    pthread_cond_init(&own->moved, NULL);
    own->started = pthread_create(&own->thread, NULL, work, own) == 0;
}

void own_runs_ask(own_runs *own, mpi_block block, gough_outcome *outcome) {
    pthread_mutex_lock(&own->lock);
    own->block = block;
    own->outcome = outcome;
    own->count = 0;
    own->asked = true;
    pthread_cond_signal(&own->moved);
    pthread_mutex_unlock(&own->lock);
}

bool own_runs_finished(own_runs *own, size_t *count, gough_status *status, gough_error *error) {
    pthread_mutex_lock(&own->lock);
    const bool finished = !own->asked;
    if (finished) {
        *count = own->count;
        *status = own->status;
        *error = own->error;
    }
    pthread_mutex_unlock(&own->lock);
    return finished;
}

void own_runs_stop(own_runs *own) {
    pthread_mutex_lock(&own->lock);
    own->stop = true;
    pthread_mutex_unlock(&own->lock);
}

void own_runs_end(own_runs *own) {
    if (own->started) {
        pthread_mutex_lock(&own->lock);
        own->leave = true;
        pthread_cond_signal(&own->moved);
        pthread_mutex_unlock(&own->lock);
        pthread_join(own->thread, NULL);
    }
    pthread_cond_destroy(&own->moved);
    pthread_mutex_destroy(&own->lock);
}
