// What happens in one run of a file of trees, and nodes whose time is that of the run.
#pragma once

#include <map>
#include <sstream>

#include "behaviortree_cpp/bt_factory.h"

namespace scripted
{
using BT::NodeStatus;

struct Script
{
  int ticks;
  bool ok;
  unsigned chance;
};

// What happens in one run of a file: how often each node was started, the time, the trace.
struct Stage
{
  std::map<std::string, int> starts;
  long now_ms = 0;
  std::ostringstream trace;

  Script next(const std::string& id)
  {
    const std::string key = id + ":" + std::to_string(starts[id]++);
    unsigned hash = 2166136261u;
    for(const unsigned char c : key)
    {
      hash = (hash ^ c) * 16777619u;
    }
    hash ^= hash >> 15;
    return { 1 + int(hash % 3), hash / 3 % 10 != 0, hash / 30 };
  }

  void tell(const std::string& what, const std::string& id, const std::string& more = "")
  {
    trace << what << " " << id << more << "\n";
  }
};

inline Stage* stage = nullptr;

class VirtualSleep : public BT::StatefulActionNode
{
public:
  using StatefulActionNode::StatefulActionNode;
  NodeStatus onStart() override
  {
    until_ms_ = stage->now_ms + getInput<unsigned>("msec").value();
    return onRunning();
  }
  NodeStatus onRunning() override
  {
    return stage->now_ms >= until_ms_ ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void onHalted() override {}

private:
  long until_ms_ = 0;
};

class VirtualTimeout : public BT::DecoratorNode
{
public:
  using DecoratorNode::DecoratorNode;
  NodeStatus tick() override
  {
    if(status() == NodeStatus::IDLE)
    {
      until_ms_ = stage->now_ms + getInput<unsigned>("msec").value();
    }
    else if(stage->now_ms > until_ms_)  // at that time both are right, and the engine lets its child end
    {
      haltChild();
      return NodeStatus::FAILURE;
    }
    setStatus(NodeStatus::RUNNING);
    const NodeStatus ended = child_node_->executeTick();
    if(ended != NodeStatus::RUNNING)
    {
      resetChild();
    }
    return ended;
  }

private:
  long until_ms_ = 0;
};

}  // namespace scripted
