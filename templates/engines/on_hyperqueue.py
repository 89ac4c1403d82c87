"""Runs the lines of a file as tasks of HyperQueue (pip install hyperqueue), and waits for them.

A server that was started with `hq server start` is found by the directory in HQ_SERVER_DIR; without it a server with one worker on all cores of
this machine is started for as long as the runs take.
"""

import os
import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.client import Client
from hyperqueue.cluster import WorkerConfig


def run(client, lines):
    # A task that fails is no reason to stop the others.
    job = Job(max_fails=None)
    for line in lines:
        job.program(["sh", "-c", line], stdout=None, stderr=None)
    submitted = client.submit(job)
    return client.wait_for_jobs([submitted], raise_on_error=False)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        lines = [line.rstrip("\n") for line in file if line.strip()]
    server = os.environ.get("HQ_SERVER_DIR")
    if server:
        return run(Client(server), lines)
    with LocalCluster() as cluster:
        cluster.start_worker(WorkerConfig())
        return run(cluster.client(), lines)


if __name__ == "__main__":
    sys.exit(0 if main() else 1)
