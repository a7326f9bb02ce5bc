"""ROS's own master on a free port, without roscore's log files and rosout: prints its URI, then serves until it is
ended."""

import time

from rosmaster.master import Master

master = Master(port=0)
master.start()
print(master.uri, flush=True)
while master.ok():
    time.sleep(1.0)
