// Nodes that do what a script says, with the ports that a file of trees declares.
#pragma once

#include <cstdio>
#include <functional>
#include <map>
#include <utility>

#include "behaviortree_cpp/bt_factory.h"
#include "stage.h"

namespace scripted
{
constexpr int ITEMS = 2;

inline std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for(const char c : text)
  {
    out += (c == '\n') ? "\\n" : (c == '\r') ? "\\r" : std::string(1, c);
  }
  return out + "\"";
}

inline std::string shown(double value)
{
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return value != value ? "nan" : buffer;
}
inline std::string shown(int value) { return std::to_string(value); }
inline std::string shown(unsigned value) { return std::to_string(value); }
inline std::string shown(bool value) { return value ? "true" : "false"; }
inline std::string shown(const std::string& value) { return quoted(value); }

// How a node reads and writes a port of one C++ type.
struct Type
{
  std::function<BT::PortInfo(BT::PortDirection)> port;
  std::function<std::string(const BT::TreeNode&, const std::string&)> read;
  std::function<void(BT::TreeNode&, const std::string&, unsigned)> write;
  std::function<void(BT::Blackboard&, const std::string&)> given;
};

template <typename T>
Type typed(std::function<T(unsigned)> made, T given)
{
  return {
    [](BT::PortDirection direction) { return BT::CreatePort<T>(direction, "port").second; },
    [](const BT::TreeNode& node, const std::string& name) {
      const auto value = node.getInput<T>(name);
      if(!value)
      {
        throw BT::RuntimeError(value.error());
      }
      return shown(value.value());
    },
    [made](BT::TreeNode& node, const std::string& name, unsigned chance) {
      const auto result = node.setOutput(name, made(chance));
      if(!result)
      {
        throw BT::RuntimeError(result.error());
      }
    },
    [given](BT::Blackboard& board, const std::string& name) { board.set(name, given); },
  };
}

// A port without a type takes anything: what is written into it here can be read as whatever it is used for.
inline Type untyped()
{
  Type type = typed<std::string>([](unsigned) { return "1"; }, "1");
  type.port = [](BT::PortDirection direction) {
    return BT::CreatePort<BT::AnyTypeAllowed>(direction, "port").second;
  };
  type.read = [](const BT::TreeNode& node, const std::string& name) {
    const auto value = node.getInput<BT::Any>(name);
    return std::string(value ? "*" : "?");
  };
  type.given = [](BT::Blackboard&, const std::string&) {};
  return type;
}

inline const Type& type_called(const std::string& name)
{
  static const std::map<std::string, Type> types = {
    { "double", typed<double>([](unsigned chance) { return (chance % 8000) / 8.0; }, 0.5) },
    { "int", typed<int>([](unsigned chance) { return int(chance % 5); }, 3) },
    { "unsigned int", typed<unsigned>([](unsigned chance) { return chance % 300; }, 3) },
    { "bool", typed<bool>([](unsigned chance) { return chance % 2 == 1; }, true) },
    { "std::string", typed<std::string>([](unsigned chance) { return "t" + std::to_string(chance % 10); }, "x") },
    { "", untyped() },
  };
  return types.at(name);
}

struct Declared
{
  std::string id;
  std::string kind;
  std::map<std::string, std::string> inputs;  // type by port
  std::map<std::string, std::string> outputs;
  BT::PortsList ports;
};

inline bool is_unset(const BT::TreeNode& node, const std::string& port)
{
  const auto key = BT::TreeNode::getRemappedKey(port, node.getRawPortValue(port));
  if(!key)
  {
    return false;
  }
  const auto entry = node.config().blackboard->getAnyLocked(std::string(*key));
  return !entry || entry.get()->empty();
}

inline std::string values(const BT::TreeNode& node, const Declared& declared)
{
  std::string text;
  for(const auto& [name, type] : declared.inputs)
  {
    if(node.config().input_ports.count(name) != 0)
    {
      text += " " + name + "=" + (is_unset(node, name) ? "?" : type_called(type).read(node, name));
    }
  }
  return text;
}

inline void put_out(BT::TreeNode& node, const Declared& declared, unsigned chance)
{
  for(const auto& [name, type] : declared.outputs)
  {
    if(std::as_const(node).config().output_ports.count(name) != 0)
    {
      type_called(type).write(node, name, chance);
    }
  }
}

class Action : public BT::StatefulActionNode
{
public:
  Action(const std::string& name, const BT::NodeConfig& config, const Declared& declared)
    : StatefulActionNode(name, config), declared_(declared)
  {}
  NodeStatus onStart() override
  {
    script_ = stage->next(declared_.id);
    stage->tell("start", declared_.id, values(*this, declared_));
    return step();
  }
  NodeStatus onRunning() override
  {
    stage->tell("tick", declared_.id);
    return step();
  }
  void onHalted() override { stage->tell("halt", declared_.id); }

private:
  NodeStatus step()
  {
    if(--script_.ticks > 0)
    {
      return NodeStatus::RUNNING;
    }
    if(script_.ok)
    {
      put_out(*this, declared_, script_.chance);
    }
    return script_.ok ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
  const Declared& declared_;
  Script script_{};
};

class Condition : public BT::ConditionNode
{
public:
  Condition(const std::string& name, const BT::NodeConfig& config, const Declared& declared)
    : ConditionNode(name, config), declared_(declared)
  {}
  NodeStatus tick() override
  {
    const bool ok = stage->next(declared_.id).chance % 4 != 0;
    stage->tell(ok ? "true" : "false", declared_.id, values(*this, declared_));
    return ok ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }

private:
  const Declared& declared_;
};

// With: set up before the child, undone however the child ends. ForEach: the child for every item. Try, Invert.
class Decorator : public BT::DecoratorNode
{
public:
  Decorator(const std::string& name, const BT::NodeConfig& config, const Declared& declared)
    : DecoratorNode(name, config), declared_(declared)
  {}
  NodeStatus tick() override
  {
    if(status() == NodeStatus::IDLE)
    {
      stage->tell("start", declared_.id, values(*this, declared_));
      item_ = 0;
    }
    setStatus(NodeStatus::RUNNING);
    if(declared_.outputs.count("item") != 0)
    {
      put_out(*this, declared_, 0);
    }
    const NodeStatus ended = child_node_->executeTick();
    if(ended == NodeStatus::RUNNING)
    {
      return ended;
    }
    resetChild();
    if(ended == NodeStatus::SUCCESS && declared_.outputs.count("item") != 0 && ++item_ < ITEMS)
    {
      return NodeStatus::RUNNING;
    }
    stage->tell("undo", declared_.id);
    return ended;
  }
  void halt() override
  {
    const bool running = status() == NodeStatus::RUNNING;
    DecoratorNode::halt();
    if(running)
    {
      stage->tell("undo", declared_.id);
    }
  }

private:
  const Declared& declared_;
  int item_ = 0;
};

// Finally: the second child once the first one has ended, then as that one ended.
class Control : public BT::ControlNode
{
public:
  Control(const std::string& name, const BT::NodeConfig& config, const Declared&) : ControlNode(name, config)
  {}
  NodeStatus tick() override
  {
    setStatus(NodeStatus::RUNNING);
    if(first_ == NodeStatus::RUNNING)
    {
      first_ = children_nodes_[0]->executeTick();
    }
    if(first_ == NodeStatus::RUNNING || children_nodes_[1]->executeTick() == NodeStatus::RUNNING)
    {
      return NodeStatus::RUNNING;
    }
    const NodeStatus ended = first_;
    first_ = NodeStatus::RUNNING;
    resetChildren();
    return ended;
  }
  void halt() override
  {
    first_ = NodeStatus::RUNNING;
    ControlNode::halt();
  }

private:
  NodeStatus first_ = NodeStatus::RUNNING;
};

}  // namespace scripted
